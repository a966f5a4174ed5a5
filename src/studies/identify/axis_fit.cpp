#include "studies/identify/axis_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/identify/axis_fitter.hpp"
#include "studies/identify/direct.hpp"
#include "studies/identify/least_squares.hpp"
#include "studies/identify/minimise.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kSpread = 0.12;   // of a global search about its start, of the unit cube
constexpr int kSearches = 2;       // global searches at most
constexpr double kGoodFit = 1.1;   // of what rounding makes: nothing is left to search for
constexpr double kWorseFit = 1.2;  // of the residual, that holding parameters may make
constexpr int kCoarseRank = 8;     // hold_rank from which on a parameter is fitted first
constexpr double kPopulationPerFree = 1.5;
constexpr int kMostRounds = 8;         // of holding what is not shown and fitting the rest again
constexpr int kAlignments = 3;         // of hum phases and all else, one after the other
constexpr double kBlock = 0.25;        // within which residuals may be correlated [s]
constexpr double kSearchStart = 0.15;  // shares of the progress bar
constexpr double kSearchEnd = 0.75;

}  // namespace

AxisFitter::AxisFitter(AxisProblem&& problem, FitOptions options)
    : problem_(std::move(problem)),
      options_(std::move(options)),
      start_(problem_.base()),
      current_(problem_.base()) {
  for (Candidate& candidate : axis_candidates(start_, problem_.axis())) {
    const bool is_wanted = candidate.when == Candidate::When::kAlways ||
                           (candidate.when == Candidate::When::kWithVolts) == has_volts();
    if (is_wanted) {
      candidate.is_analysed_only = candidate.is_analysed_only && !is_freed(candidate.parameter.key);
      if (is_freed(candidate.parameter.key)) {
        candidate.hold_rank += 100;
      }
      candidates_.push_back(std::move(candidate));
    }
  }
  for (const Candidate& candidate : candidates_) {
    FittedParameter parameter;
    parameter.key = candidate.parameter.key;
    parameter.name = candidate.name;
    const ParameterSet one = ParameterSet::create({candidate.parameter}).value();
    parameter.start = parameter.value = one.values(start_).front();
    const bool is_held = is_fixed(candidate.parameter.key);
    if (is_held) {
      parameter.verdict = Verdict::kFixed;
    }
    results_.push_back(std::move(parameter));
    is_held_.push_back(is_held);
  }
}

void AxisFitter::report(double share) const {
  if (options_.progress) {
    options_.progress(share);
  }
}

FittedParameter& AxisFitter::result(const std::string& key, const std::string& name) {
  const auto found = std::ranges::find(results_, key, &FittedParameter::key);
  if (found != results_.end()) {
    return *found;
  }
  FittedParameter& added = results_.emplace_back();
  added.key = key;
  added.name = name;
  return added;
}

void AxisFitter::hold(std::size_t place, Verdict verdict, double sigma, double relative,
                      std::string why) {
  FittedParameter& parameter = results_[place];
  is_held_[place] = true;
  parameter.verdict = verdict;
  parameter.sigma = sigma;
  parameter.relative = relative;
  parameter.why = std::move(why);
  const ParameterSet one = ParameterSet::create({candidates_[place].parameter}).value();
  current_ = one.with_values(current_, std::vector<double>{parameter.start});
}

std::vector<std::size_t> AxisFitter::free_places() const {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!is_held_[i] && !candidates_[i].is_analysed_only) {
      places.push_back(i);
    }
  }
  return places;
}

ParameterSet AxisFitter::set_of(const std::vector<std::size_t>& places) const {
  std::vector<Parameter> parameters;
  parameters.reserve(places.size());
  for (const std::size_t place : places) {
    parameters.push_back(candidates_[place].parameter);
  }
  return ParameterSet::create(std::move(parameters)).value();
}

Eigen::VectorXd AxisFitter::residuals(const ParameterSet& set, const Eigen::VectorXd& units) const {
  return problem_.residuals(set, {units.data(), static_cast<std::size_t>(units.size())});
}

/// The local search, over the parameters of at least a hold_rank.
void AxisFitter::polish(int iterations, int least_rank) {
  std::vector<std::size_t> places = free_places();
  std::erase_if(places, [&](std::size_t p) { return candidates_[p].hold_rank < least_rank; });
  const ParameterSet set = set_of(places);
  problem_.set_base(current_);
  const std::vector<double> units = set.units(current_);
  LeastSquaresOptions options;
  options.iterations = iterations;
  options.tolerance = has_volts() ? 1e-5 : 1e-6;  // without, the valleys are longer
  options.stop = options_.stop;
  const LeastSquaresFit fit = least_squares(
      [&](const Eigen::VectorXd& u) { return residuals(set, u); },
      Eigen::Map<const Eigen::VectorXd>(units.data(), static_cast<Eigen::Index>(units.size())),
      options);
  current_ = set.with_units(current_, {fit.x.data(), static_cast<std::size_t>(fit.x.size())});
}

/// Brings the phases of the hum in further records up to date.
void AxisFitter::align() {
  problem_.set_base(current_);
  align_hum(problem_);
}

/// One global search from where the fit stands, and the local one after it.
void AxisFitter::search(int number, const config::MachineFile& begin) {
  const config::MachineFile best = std::exchange(current_, begin);
  const double best_rms = rms_of(best);
  const ParameterSet set = set_of(free_places());
  problem_.set_base(current_);
  MinimiseOptions options;
  options.start = set.units(current_);
  options.spread = kSpread;
  options.population =
      8 + static_cast<std::size_t>(kPopulationPerFree * static_cast<double>(set.size()));
  options.evaluations = options_.evaluations / kSearches;
  options.seed = options_.seed + static_cast<std::uint32_t>(number);
  options.stop = options_.stop;
  options.progress = [&](double share, double) {
    report(kSearchStart + (kSearchEnd - kSearchStart) * (number + share) / kSearches);
  };
  const Minimum found = minimise(
      [&](std::span<const double> units) { return problem_.residuals(set, units).squaredNorm(); },
      options);
  current_ = set.with_units(current_, found.x);
  fit_.evaluations += found.evaluations;
  polish(10, kCoarseRank);
  polish(30);
  if (rms_of(current_) >= best_rms) {
    current_ = best;
  }
}

/// Global searches while more is left of the residual than rounding makes: the first from the
/// direct estimates, others from the best so far.
void AxisFitter::search_further(const config::MachineFile& begin) {
  for (int number = 0; number < kSearches && options_.evaluations > 0; ++number) {
    report(kSearchStart + (kSearchEnd - kSearchStart) * number / kSearches);
    if (rms_of(current_) < kGoodFit * fit_.rounding_rms) {
      return;
    }
    search(number, number == 0 ? begin : current_);
  }
}

/// Holds what the data do not show, fits the rest again, and so on until all of the rest is shown.
void AxisFitter::judge_and_hold() {
  std::vector<std::size_t> places;  // all but what the user fixed
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (results_[i].verdict != Verdict::kFixed) {
      places.push_back(i);
    }
  }
  const ParameterSet set = set_of(places);
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<JudgedCandidate> judged;
    const std::vector<double> values = set.values(current_);
    const std::vector<double> units = set.units(current_);
    for (std::size_t i = 0; i < places.size(); ++i) {
      judged.push_back({&candidates_[places[i]], values[i], units[i], is_held_[places[i]]});
    }
    problem_.set_base(current_);
    const Judgement judgement = judge(
        judged, [&](const Eigen::VectorXd& u) { return residuals(set, u); },
        static_cast<Eigen::Index>(std::lround(kBlock / current_.period)));
    report(kSearchEnd + (1.0 - kSearchEnd) * (round + 1.0) / (kMostRounds + 1.0));
    const config::MachineFile fitted = current_;
    const double residual = rms_of(fitted);
    if (!take(places, judgement) || (options_.stop != nullptr && options_.stop->load())) {
      return;
    }
    polish(has_volts() ? 20 : 60);
    if (!(rms_of(current_) < kWorseFit * residual)) {
      current_ = fitted;  // the starting values do not fit at all: held where the fit has them
    }
  }
}

/// Notes a judgement. @returns whether parameters were held that had been fitted
bool AxisFitter::take(const std::vector<std::size_t>& places, const Judgement& judgement) {
  bool must_fit = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ParameterJudgement& one = judgement[i];
    if (is_held_[places[i]]) {
      continue;
    }
    results_[places[i]].sigma = one.sigma;
    results_[places[i]].relative = one.relative;
    if (one.verdict != Verdict::kIdentified) {
      must_fit = must_fit || !candidates_[places[i]].is_analysed_only;
      hold(places[i], one.verdict, one.sigma, one.relative, one.why);
    }
  }
  return must_fit;
}

double AxisFitter::rms_of(const config::MachineFile& machine) {
  problem_.set_base(machine);
  const ParameterSet none;
  const Eigen::VectorXd all = problem_.residuals(none, {});
  return std::sqrt(all.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(all.size(), 1)));
}

/// Frequency and phase of a hum that is not there mean nothing.
void AxisFitter::doubt_hum_without_amplitude() {
  const auto is_unknown = [](const FittedParameter& p) {
    return p.key.ends_with("hum_amplitude_mV") && p.verdict == Verdict::kUnidentified;
  };
  if (std::ranges::none_of(results_, is_unknown)) {
    return;
  }
  for (FittedParameter& p : results_) {
    if (p.key.find(".hum_") != std::string::npos && p.verdict == Verdict::kIdentified) {
      p.verdict = Verdict::kUnidentified;
      p.why = "there is no hum to speak of";
    }
  }
}

AxisFit AxisFitter::run() {
  problem_.use(1);  // further records join a fit that is near already
  estimate_directly();
  report(0.05);
  const config::MachineFile begin = current_;
  polish(10, kCoarseRank);
  polish(has_volts() ? 20 : 60);
  search_further(begin);
  problem_.use(problem_.total());
  for (int i = 0; i < kAlignments && problem_.total() > 1; ++i) {
    align();
    polish(15);
  }
  judge_and_hold();
  estimate_gains();
  fit_.residual_rms = rms_of(current_);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const ParameterSet one = ParameterSet::create({candidates_[i].parameter}).value();
    results_[i].value = one.values(current_).front();
    if (results_[i].verdict == Verdict::kIdentified && results_[i].relative > kMostRelative) {
      results_[i].verdict = Verdict::kUnidentified;
      results_[i].why = "depends too much on others that are not identified";
    }
  }
  doubt_hum_without_amplitude();
  fit_.machine = current_;
  fit_.parameters = std::move(results_);
  fit_.was_stopped = options_.stop != nullptr && options_.stop->load();
  report(1.0);
  return std::move(fit_);
}

AxisFit fit_axis(AxisProblem problem, const FitOptions& options) {
  return AxisFitter(std::move(problem), options).run();
}

}  // namespace twin::studies::identify
