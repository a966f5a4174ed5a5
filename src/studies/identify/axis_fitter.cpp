#include "studies/identify/axis_fitter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "studies/identify/direct.hpp"
#include "studies/identify/least_squares.hpp"
#include "studies/identify/measured_parameters.hpp"
#include "studies/identify/torque_servo.hpp"
#include "studies/search/minimise.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kSpread = 0.12;     // of a global search about its start, of the unit cube
constexpr int kSearches = 2;         // global searches at most
constexpr double kGoodFit = 1.1;     // of what rounding makes: nothing is left to search for
constexpr double kWorseFit = 1.015;  // of the residual, that holding parameters may make
constexpr int kFreedRank = 100;      // added to that of what the user frees
constexpr int kCoarseRank = 8;       // hold_rank from which on a parameter is fitted first
constexpr double kPopulationPerFree = 1.5;
constexpr int kMostRounds = 8;         // of holding what is not shown and fitting the rest again
constexpr int kAlignments = 3;         // of hum phases and all else, one after the other
constexpr double kSearchStart = 0.15;  // shares of the progress bar
constexpr double kSearchEnd = 0.75;

double rms(const Eigen::VectorXd& all) {
  return std::sqrt(all.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(all.size(), 1)));
}

}  // namespace

AxisFitter::AxisFitter(AxisProblem&& problem, FitOptions options)
    : problem_(std::move(problem)),
      options_(std::move(options)),
      start_(problem_.base()),
      current_(problem_.base()) {
  for (Candidate& candidate : axis_candidates(start_, problem_.axis())) {
    if (!is_wanted(candidate.when)) {
      continue;
    }
    Searched parameter;
    parameter.result.key = candidate.parameter.key;
    parameter.result.name = candidate.name;
    const ParameterSet one = ParameterSet::create({candidate.parameter}).value();
    parameter.result.start = parameter.result.value = one.values(start_).front();
    if (options_.is_freed(candidate.parameter.key)) {
      candidate.is_analysed_only = false;
      candidate.hold_rank += kFreedRank;
    }
    if (options_.is_fixed(candidate.parameter.key)) {
      parameter.is_held = true;
      parameter.result.verdict = Verdict::kFixed;
    }
    parameter.candidate = std::move(candidate);
    searched_.push_back(std::move(parameter));
  }
  if (options_.held_out_share > 0.0) {
    records_.assign(problem_.all_records().begin(), problem_.all_records().end());
    std::vector<AxisRecord> first_parts;
    for (const AxisRecord& record : records_) {
      first_parts.push_back(
          part_of(record, 0, trained_rows(record, options_.held_out_share), start_.period));
    }
    problem_.set_records(std::move(first_parts));
  }
}

bool AxisFitter::is_wanted(Candidate::When when) const {
  switch (when) {
    case Candidate::When::kWithVolts:
      return has_volts();
    case Candidate::When::kWithoutVolts:
      return !has_volts();
    case Candidate::When::kWithTable:
      return problem_.ever_shows_table();
    default:
      return true;
  }
}

void AxisFitter::report(double share) const {
  if (options_.progress) {
    options_.progress(share);
  }
}

void AxisFitter::hold(Searched& parameter, Verdict verdict, double sigma, double relative,
                      std::string why) {
  parameter.is_held = true;
  parameter.result.verdict = verdict;
  parameter.result.sigma = sigma;
  parameter.result.relative = relative;
  parameter.result.why = std::move(why);
  const ParameterSet one = ParameterSet::create({parameter.candidate.parameter}).value();
  current_ = one.with_values(current_, std::vector<double>{parameter.result.start});
}

AxisFitter::Indices AxisFitter::free_indices() const {
  Indices indices;
  const bool shows_table = problem_.shows_table();
  for (std::size_t i = 0; i < searched_.size(); ++i) {
    const bool is_seen = shows_table || searched_[i].candidate.when != Candidate::When::kWithTable;
    if (!searched_[i].is_held && !searched_[i].candidate.is_analysed_only && is_seen) {
      indices.push_back(i);
    }
  }
  return indices;
}

ParameterSet AxisFitter::set_of(const Indices& indices) const {
  std::vector<Parameter> parameters;
  parameters.reserve(indices.size());
  for (const std::size_t i : indices) {
    parameters.push_back(searched_[i].candidate.parameter);
  }
  return ParameterSet::create(std::move(parameters)).value();
}

Eigen::VectorXd AxisFitter::residuals(const ParameterSet& set, const Eigen::VectorXd& units) const {
  return problem_.residuals(set, {units.data(), static_cast<std::size_t>(units.size())});
}

/// The local search, over the parameters of at least a hold_rank.
void AxisFitter::polish(int iterations, int least_rank, double tolerance) {
  Indices indices = free_indices();
  std::erase_if(indices,
                [&](std::size_t i) { return searched_[i].candidate.hold_rank < least_rank; });
  const ParameterSet set = set_of(indices);
  problem_.set_base(current_);
  const std::vector<double> units = set.units(current_);
  LeastSquaresOptions options;
  options.iterations = iterations;
  options.tolerance = has_volts() ? tolerance : 0.1 * tolerance;  // without, the valleys are longer
  options.stop = options_.stop;
  // Where the model lacks something, the way to the best is not straight.
  options.reuses = rms_of(current_) <= kLackOfFit * fit_.rounding_rms ? options.reuses : 0;
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
  const config::MachineFile best = current_;
  current_ = begin;
  const double best_cost = cost_of(best);
  const ParameterSet set = set_of(free_indices());
  problem_.set_base(current_);
  search::MinimiseOptions options;
  options.start = set.units(current_);
  options.spread = kSpread;
  options.population =
      8 + static_cast<std::size_t>(kPopulationPerFree * static_cast<double>(set.size()));
  options.evaluations = options_.evaluations / kSearches;
  options.seed = options_.seed + static_cast<std::uint32_t>(number);
  options.threads = 0;
  options.stop = options_.stop;
  options.progress = [&](double share, double) {
    report(kSearchStart + (kSearchEnd - kSearchStart) * (number + share) / kSearches);
  };
  const search::Minimum found = search::minimise(
      [&](std::span<const double> units) { return problem_.residuals(set, units).squaredNorm(); },
      options);
  current_ = set.with_units(current_, found.x);
  fit_.evaluations += found.evaluations;
  polish(10, kCoarseRank);
  polish(30);
  if (cost_of(current_) >= best_cost) {
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
  Indices indices;  // of all but what the user fixed
  for (std::size_t i = 0; i < searched_.size(); ++i) {
    if (searched_[i].result.verdict != Verdict::kFixed && !searched_[i].is_measured) {
      indices.push_back(i);
    }
  }
  const ParameterSet set = set_of(indices);
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<JudgedCandidate> judged;
    const std::vector<double> values = set.values(current_);
    const std::vector<double> units = set.units(current_);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const Searched& parameter = searched_[indices[i]];
      judged.push_back({.candidate = &parameter.candidate,
                        .value = values[i],
                        .unit = units[i],
                        .start = parameter.result.start,
                        .is_held = parameter.is_held});
    }
    problem_.set_base(current_);
    const Judgement judgement = judge(
        judged, [&](const Eigen::VectorXd& u) { return residuals(set, u); },
        static_cast<Eigen::Index>(std::lround(AxisProblem::kBlock / current_.period)),
        problem_.rounding_errors());
    report(kSearchEnd + (1.0 - kSearchEnd) * (round + 1.0) / (kMostRounds + 1.0));
    const config::MachineFile fitted = current_;
    const double cost = cost_of(fitted);
    if (!note(indices, judgement) || (options_.stop != nullptr && options_.stop->load())) {
      return;
    }
    polish(has_volts() ? 20 : 60);
    if (!(cost_of(current_) < kWorseFit * cost)) {
      current_ = fitted;  // the starting values do not fit at all: held where the fit has them
    }
  }
}

/// Notes a judgement. @returns whether parameters were held that had been fitted
bool AxisFitter::note(const Indices& judged, const Judgement& judgement) {
  bool must_fit = false;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const ParameterJudgement& one = judgement[i];
    Searched& parameter = searched_[judged[i]];
    if (parameter.is_held) {
      continue;
    }
    parameter.result.sigma = one.sigma;
    parameter.result.relative = one.relative;
    if (one.verdict != Verdict::kIdentified) {
      must_fit = must_fit || !parameter.candidate.is_analysed_only;
      hold(parameter, one.verdict, one.sigma, one.relative, one.why);
    }
  }
  return must_fit;
}

double AxisFitter::rms_of(const config::MachineFile& machine) const {
  return rms(problem_.residuals(machine).head(problem_.rows()));
}

double AxisFitter::cost_of(const config::MachineFile& machine) const {
  return rms(problem_.residuals(machine));
}

void AxisFitter::estimate_gains() {
  gains_ = is_torque_mode() ? measure_torque_servo(problem_, options_, current_)
                            : measure_gains(problem_, options_, current_);
}

bool AxisFitter::is_torque_mode() const {
  return start_.table.axis[problem_.axis()].drive.mode == hal::mujoco::DriveMode::kTorque;
}

bool AxisFitter::is_free(const std::string& name) const {
  const auto found = std::ranges::find_if(
      searched_, [&](const Searched& p) { return p.result.key.ends_with(name); });
  return found != searched_.end() && !found->is_held;
}

/// Reads off the records what needs no search.
void AxisFitter::estimate_directly() {
  count_ = measure_count(problem_, options_, current_);
  if (count_.verdict == Verdict::kMeasured || count_.verdict == Verdict::kUncertain) {
    const double quantum = std::abs(current_.table.axis[problem_.axis()].encoder.mm_per_count);
    fit_.rounding_rms = quantum / std::sqrt(12.0);
  }
  if (problem_.has_force()) {
    estimate_inverse();
  }
  if (is_torque_mode()) {
    estimate_gains();
    complete_torque_mode();
    return;
  }
  hal::mujoco::DriveParams& drive = current_.table.axis[problem_.axis()].drive;
  if (const auto scale = direct_scale(problem_); scale && is_free("vref_scale_rpm_per_V")) {
    drive.vref_scale_rpm_per_V = *scale;
  }
  estimate_gains();
  estimate_hum();
  if (is_free("vref_offset_mV")) {
    drive.vref_offset += direct_offset(problem_, current_);
  }
  if (!has_volts()) {
    begin_from_steady_lag();
  }
  begin_screw();
}

AxisFit AxisFitter::run() {
  problem_.use(1);  // further records join a fit that is near already
  estimate_directly();
  report(0.05);
  if (is_torque_mode()) {
    join_held_out();
    return finish_torque_mode();
  }
  config::MachineFile begin = current_;
  polish(10, kCoarseRank);
  polish(has_volts() ? 20 : 60);
  hold_friction_where_unfit();
  drop_doubtful_hum();
  if (!is_free("hum_amplitude_mV")) {
    begin.table.axis[problem_.axis()].drive.hum_amplitude =
        current_.table.axis[problem_.axis()].drive.hum_amplitude;
  }
  search_further(begin);
  problem_.use(problem_.total());
  for (int i = 0; i < kAlignments && problem_.total() > 1; ++i) {
    align();
    polish(15);
  }
  join_held_out();
  hold_friction_where_unfit();
  retry_screw();
  judge_and_hold();
  estimate_gains();
  return finish();
}

/// The result, from where the fit stands.
AxisFit AxisFitter::finish() {
  fit_.residual_rms = rms_of(current_);
  for (Searched& parameter : searched_) {
    const ParameterSet one = ParameterSet::create({parameter.candidate.parameter}).value();
    FittedParameter& result = parameter.result;
    result.value = one.values(current_).front();
    if (result.verdict == Verdict::kIdentified && result.relative > kMostRelative) {
      result.verdict = Verdict::kUnidentified;
      result.why = "depends too much on others that are not identified";
    }
  }
  doubt_hum_without_amplitude();
  widen_by_mass();
  judge_lack_of_fit();
  judge_screw();
  doubt_by_lacking_features();
  if (!has_volts()) {
    doubt_gains_without_volts();
  }
  derive_lost_motion();
  fit_.machine = current_;
  for (Searched& parameter : searched_) {
    fit_.parameters.push_back(std::move(parameter.result));
  }
  note_screw_that_is_not_seen();
  fit_.parameters.push_back(std::move(count_));
  std::ranges::move(loads_, std::back_inserter(fit_.parameters));
  std::ranges::move(gains_, std::back_inserter(fit_.parameters));
  fit_.was_stopped = options_.stop != nullptr && options_.stop->load();
  report(1.0);
  return std::move(fit_);
}

AxisFit fit_axis(AxisProblem problem, const FitOptions& options) {
  return AxisFitter(std::move(problem), options).run();
}

}  // namespace twin::studies::identify
