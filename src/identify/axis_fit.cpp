#include "identify/axis_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/direct.hpp"
#include "identify/judge.hpp"
#include "identify/least_squares.hpp"
#include "identify/minimise.hpp"
#include "identify/quantum.hpp"

namespace twin::identify {
namespace {

constexpr double kSpread = 0.12;  // of a global search about its start, of the unit cube
constexpr int kSearches = 2;      // global searches at most
constexpr double kGoodFit = 1.1;  // of what rounding makes: nothing is left to search for
constexpr int kCoarseRank = 8;    // hold_rank from which on a parameter is fitted first
constexpr double kPopulationPerFree = 1.5;
constexpr int kMostRounds = 5;         // of holding what is not shown and fitting the rest again
constexpr double kBlock = 0.25;        // within which residuals may be correlated [s]
constexpr double kSearchStart = 0.15;  // shares of the progress bar
constexpr double kSearchEnd = 0.75;
constexpr double kHumRange = 0.5;  // of 1 / duration, about the frequency found

bool contains(const std::vector<std::string>& keys, const std::string& key) {
  return std::ranges::find(keys, key) != keys.end();
}

/// The fit of one axis on its way.
class AxisFitter {
 public:
  AxisFitter(AxisProblem&& problem, const FitOptions& options);
  AxisFit run();

 private:
  void estimate_directly();
  void estimate_quantum();
  void estimate_gains();
  void estimate_hum();
  void search(int number, const config::MachineFile& begin);
  void search_further(const config::MachineFile& begin);
  void polish(int iterations, int least_rank = 0);
  void judge_and_hold();
  bool take(const std::vector<std::size_t>& places, const Judgement& judgement);
  std::vector<std::size_t> free_places() const;
  ParameterSet set_of(const std::vector<std::size_t>& places) const;
  Eigen::VectorXd residuals(const ParameterSet& set, const Eigen::VectorXd& units) const;
  void hold(std::size_t place, Verdict verdict, double sigma, double relative, std::string why);
  void report(double share) const;
  FittedParameter& result(const std::string& key, const std::string& name);
  double rms_of(const config::MachineFile& machine);

  AxisProblem problem_;
  FitOptions options_;
  config::MachineFile start_;
  config::MachineFile current_;
  std::vector<Candidate> candidates_;
  std::vector<FittedParameter> results_;  // one for each candidate, then what is measured directly
  std::vector<bool> is_held_;
  AxisFit fit_;
};

AxisFitter::AxisFitter(AxisProblem&& problem, const FitOptions& options)
    : problem_(std::move(problem)),
      options_(options),
      start_(problem_.base()),
      current_(problem_.base()) {
  const bool has_volts = std::ranges::all_of(problem_.records(), &AxisRecord::has_volts);
  for (Candidate& candidate : axis_candidates(start_, problem_.axis())) {
    const bool is_wanted = candidate.when == Candidate::When::kAlways ||
                           (candidate.when == Candidate::When::kWithVolts) == has_volts;
    if (is_wanted) {
      candidate.is_analysed_only =
          candidate.is_analysed_only && !contains(options_.freed, candidate.parameter.key);
      if (contains(options_.freed, candidate.parameter.key)) {
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
    const bool is_fixed = contains(options_.fixed, candidate.parameter.key);
    if (is_fixed) {
      parameter.verdict = Verdict::kFixed;
    }
    results_.push_back(std::move(parameter));
    is_held_.push_back(is_fixed);
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
  for (const std::size_t place : places) {
    parameters.push_back(candidates_[place].parameter);
  }
  return ParameterSet::create(std::move(parameters)).value();
}

Eigen::VectorXd AxisFitter::residuals(const ParameterSet& set, const Eigen::VectorXd& units) const {
  return problem_.residuals(set, {units.data(), static_cast<std::size_t>(units.size())});
}

void AxisFitter::estimate_quantum() {
  hal::EncoderParams& encoder = current_.table.axis[problem_.axis()].encoder;
  const std::string key = table_section(problem_.axis()) + "encoder_um_per_count";
  FittedParameter& parameter = result(key, "encoder count");
  parameter.start = parameter.value = encoder.mm_per_count * 1e3;
  if (contains(options_.fixed, key)) {
    parameter.verdict = Verdict::kFixed;
    return;
  }
  const auto quantum = quantum_of(problem_.records().front().measured);
  if (!quantum) {
    parameter.verdict = Verdict::kUnidentified;
    parameter.why = "the measured values are not whole multiples of anything";
    return;
  }
  encoder.mm_per_count = std::copysign(*quantum, encoder.mm_per_count);
  parameter.value = encoder.mm_per_count * 1e3;
  parameter.verdict = Verdict::kMeasured;
  fit_.rounding_rms = *quantum / std::sqrt(12.0);
}

void AxisFitter::estimate_gains() {
  if (!problem_.records().front().has_volts()) {
    return;
  }
  const hal::AxisParams& axis = current_.table.axis[problem_.axis()];
  GainFit gains =
      fit_gains(problem_.records(), axis.drive.vref_scale_rpm_per_V / 60.0 * axis.screw.lead,
                current_.period);
  gains.gains.kp = std::max(gains.gains.kp, 0.0);
  gains.gains.kd = std::max(gains.gains.kd, 0.0);
  gains.gains.kf = std::max(gains.gains.kf, 0.0);
  servo::Gains& servo = current_.servo[problem_.axis()];
  const std::string section = problem_.axis() == hal::kX ? "servo.x." : "servo.y.";
  struct Line {
    const char* key;
    const char* name;
    double servo::Gains::*field;
    double natural;
  };
  for (const Line& line : {Line{"kp_per_s", "position gain Kp", &servo::Gains::kp, 1.0},
                           Line{"kd", "derivative gain Kd", &servo::Gains::kd, 0.02},
                           Line{"kf", "velocity feedforward Kf", &servo::Gains::kf, 0.05},
                           Line{"ka_s", "acceleration feedforward Ka", &servo::Gains::ka, 4e-4},
                           Line{"trim_V", "trim", &servo::Gains::trim_V, 4e-3}}) {
    FittedParameter& parameter = result(section + line.key, line.name);
    parameter.start = parameter.value = servo.*line.field;
    parameter.sigma = gains.sigma.*line.field;
    parameter.relative =
        parameter.sigma / std::max(std::abs(gains.gains.*line.field), line.natural);
    if (contains(options_.fixed, parameter.key)) {
      parameter.verdict = Verdict::kFixed;
      parameter.sigma = 0.0;
    } else if (parameter.relative < kMostRelative) {
      parameter.verdict = Verdict::kMeasured;
      servo.*line.field = parameter.value = gains.gains.*line.field;
    } else {
      parameter.verdict = Verdict::kUnidentified;
      parameter.why = "the drive commands do not show it";
    }
  }
}

void AxisFitter::estimate_hum() {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].parameter.key.find(".hum_") != std::string::npos) {
      if (is_held_[i]) {
        return;  // the user knows it
      }
      places.push_back(i);
    }
  }
  if (direct_hum(problem_, current_)) {
    Parameter& frequency = candidates_[places[1]].parameter;
    const double found = current_.table.axis[problem_.axis()].drive.hum_frequency_Hz;
    const double range =
        kHumRange /
        (static_cast<double>(problem_.records().front().measured.size()) * current_.period);
    frequency.min = found - range;
    frequency.max = found + range;
    return;
  }
  for (const std::size_t place : places) {
    hold(place, Verdict::kUnidentified, 0.0, 0.0, "no tone stands out");
  }
  current_.table.axis[problem_.axis()].drive.hum_amplitude = 0.0;
  results_[places[0]].verdict = Verdict::kMeasured;
  results_[places[0]].value = 0.0;
}

void AxisFitter::estimate_directly() {
  estimate_quantum();
  hal::DriveParams& drive = current_.table.axis[problem_.axis()].drive;
  const auto is_free = [&](const std::string& name) {
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_[i].parameter.key.ends_with(name)) {
        return !is_held_[i];
      }
    }
    return false;
  };
  if (const auto scale = direct_scale(problem_); scale && is_free("vref_scale_rpm_per_V")) {
    drive.vref_scale_rpm_per_V = *scale;
  }
  estimate_gains();
  estimate_hum();
  if (is_free("vref_offset_mV")) {
    drive.vref_offset += direct_offset(problem_, current_);
  }
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
  options.stop = options_.stop;
  const LeastSquaresFit fit = least_squares(
      [&](const Eigen::VectorXd& u) { return residuals(set, u); },
      Eigen::Map<const Eigen::VectorXd>(units.data(), static_cast<Eigen::Index>(units.size())),
      options);
  current_ = set.with_units(current_, {fit.x.data(), static_cast<std::size_t>(fit.x.size())});
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
    if (!take(places, judgement) || (options_.stop != nullptr && options_.stop->load())) {
      return;
    }
    polish(15);
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

AxisFit AxisFitter::run() {
  estimate_directly();
  report(0.05);
  const config::MachineFile begin = current_;
  polish(10, kCoarseRank);
  polish(20);
  search_further(begin);
  judge_and_hold();
  estimate_gains();
  fit_.residual_rms = rms_of(current_);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const ParameterSet one = ParameterSet::create({candidates_[i].parameter}).value();
    results_[i].value = one.values(current_).front();
  }
  fit_.machine = current_;
  fit_.parameters = std::move(results_);
  fit_.was_stopped = options_.stop != nullptr && options_.stop->load();
  report(1.0);
  return std::move(fit_);
}

}  // namespace

AxisFit fit_axis(AxisProblem problem, const FitOptions& options) {
  return AxisFitter(std::move(problem), options).run();
}

}  // namespace twin::identify
