#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/linear_algebra.hpp"
#include "studies/identify/axis_fitter.hpp"

// The parts of a fit that are about a screw that gives.
namespace twin::studies::identify {
namespace {

constexpr double kScrewDifference = 1e-4;   // of the unit cube
constexpr double kDoubtOfHeld = 0.3;        // relative, of a held value
constexpr double kNaturalLostMotion = 1.0;  // so little is as good as none [um]
constexpr double kCreep = 0.02;             // of the peak velocity, within which sgn v turns
constexpr std::array kOtherStiffness{0.1, 0.4, 2.5};
constexpr double kStiffShare = 0.5;  // of the stiffest there is in a search
constexpr double kCloseFit = 1.1;    // of what rounding makes
constexpr double kSoftest = 1e3;     // that a search begins at [N/mm]
constexpr double kStiffest = 1e6;    // [N/mm]
constexpr double kMostPlay = 0.2;    // [mm]

/// 2 Fc / k + play: what the table lags behind the screw by, one way less the other [um].
double lost_motion(const config::MachineFile& machine, hal::Axis axis) {
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  return 1e3 * (params.screw.backlash + 2.0 * params.friction.coulomb / params.screw.stiffness);
}

/// Scale less encoder by least squares over its causes: position, velocity, acceleration, direction.
Eigen::Vector4d shares_of(const AxisRecord& record, double period) {
  const auto rows = static_cast<Eigen::Index>(record.scale.size());
  double peak = 0.0;
  for (const motion::Reference& r : record.command) {
    peak = std::max(peak, std::abs(r.velocity));
  }
  Eigen::MatrixXd causes(rows, 4);
  Eigen::VectorXd apart(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const motion::Reference& r = record.command[row];
    const double velocity = measured_velocity(record, row, period);
    causes.row(k) << record.measured[row], velocity, r.acceleration,
        std::tanh(velocity / std::max(kCreep * peak, 1e-9));
    apart[k] = record.scale[row] - record.measured[row];
  }
  const std::size_t first = settling_rows(record, period);
  for (Eigen::Index i = 0; i < 4; ++i) {
    drop_slow(causes.col(i), record, period, AxisProblem::kForgetting, first);
  }
  drop_slow(apart, record, period, AxisProblem::kForgetting, first);
  return transposed_product(normal_inverse(causes), transposed_product(causes, apart));
}

}  // namespace

/// Stiffness and play where the search begins, from what a scale says beside the encoder: the slide
/// lags by m a / k, and by half the lost motion against its direction.
void AxisFitter::begin_screw() {
  const AxisRecord& record = problem_.records().front();
  if (!record.has_scale() || !is_free("screw_stiffness_N_per_um") ||
      !is_free("screw_backlash_um")) {
    return;
  }
  hal::mujoco::AxisParams& axis = current_.table.axis[problem_.axis()];
  const Eigen::Vector4d shares = shares_of(record, current_.period);
  if (shares[2] < 0.0) {
    axis.screw.stiffness = std::clamp(-1e-3 * axis.moving_mass / shares[2], kSoftest, kStiffest);
  }
  const double stretch = 2.0 * axis.friction.coulomb / axis.screw.stiffness;
  axis.screw.backlash = std::clamp(-2.0 * shares[3] - stretch, 0.0, kMostPlay);
}

/// Begins again with a softer and a stiffer screw of the same lost motion, and keeps what fits best:
/// a stiff screw is one whose stiffness nothing shows, so that a search does not come back from it.
void AxisFitter::retry_screw() {
  if (!problem_.shows_table() || !is_free("screw_stiffness_N_per_um") ||
      !is_free("screw_backlash_um")) {
    return;
  }
  for (const double factor : kOtherStiffness) {
    const config::MachineFile best = current_;
    const double cost = cost_of(best);
    hal::mujoco::AxisParams& axis = current_.table.axis[problem_.axis()];
    const double lost = 1e-3 * lost_motion(current_, problem_.axis());
    axis.screw.stiffness = std::clamp(axis.screw.stiffness * factor, kSoftest, kStiffest);
    const double stretch = 2.0 * axis.friction.coulomb / axis.screw.stiffness;
    axis.screw.backlash = std::clamp(lost - stretch, 0.0, kMostPlay);
    polish(15);
    if (!(cost_of(current_) < cost)) {
      current_ = best;
    }
  }
}

/// What of a screw that gives a record without the table's position does not show.
void AxisFitter::note_screw_that_is_not_seen() {
  if (!start_.table.has_giving_screws() || problem_.ever_shows_table()) {
    return;
  }
  for (Candidate& candidate : axis_candidates(start_, problem_.axis())) {
    if (candidate.when != Candidate::When::kWithTable) {
      continue;
    }
    FittedParameter& parameter = fit_.parameters.emplace_back();
    const ParameterSet one = ParameterSet::create({candidate.parameter}).value();
    parameter.key = candidate.parameter.key;
    parameter.name = candidate.name;
    parameter.start = parameter.value = one.values(start_).front();
    parameter.verdict = Verdict::kUnidentified;
    parameter.why = "wants the position of the table: a column x_table or y_table, or --at-table";
    if (options_.is_fixed(parameter.key)) {
      parameter.verdict = Verdict::kFixed;
      parameter.why.clear();
    }
  }
}

/// Whether positions and scales are fitted as well as counts allow.
bool AxisFitter::is_screw_fitted() const {
  const double of_scale = problem_.scale_rounding_rms();
  const bool fits = fit_.rounding_rms > 0.0 && fit_.residual_rms <= kCloseFit * fit_.rounding_rms;
  const bool scale_fits =
      !(fit_.scale_rms > 0.0) || (of_scale > 0.0 && fit_.scale_rms <= kCloseFit * of_scale);
  return fits && scale_fits;
}

/// What a screw adds is small: where more is left than rounding makes, none of it is certain.
void AxisFitter::judge_screw() {
  fit_.scale_rms = problem_.scale_rms(current_);
  for (Searched& parameter : searched_) {
    if (parameter.result.key.ends_with("screw_stiffness_N_per_um") &&
        parameter.result.value > kStiffShare * parameter.candidate.parameter.max &&
        parameter.result.verdict == Verdict::kIdentified) {
      parameter.result.verdict = Verdict::kUncertain;
      parameter.result.why = "as stiff as the physics step lets a search go, or stiffer";
    }
  }
  if (is_screw_fitted()) {
    return;
  }
  for (Searched& parameter : searched_) {
    FittedParameter& result = parameter.result;
    if (parameter.candidate.when == Candidate::When::kWithTable &&
        result.verdict == Verdict::kIdentified) {
      result.verdict = Verdict::kUncertain;
      result.why = "the fit leaves more than rounding to counts makes";
    }
  }
}

/// Change of the lost motion by parameters in their ranges [um].
Eigen::VectorXd AxisFitter::lost_motion_by(const Indices& indices) const {
  const ParameterSet set = set_of(indices);
  const std::vector<double> units = set.units(current_);
  Eigen::VectorXd change(static_cast<Eigen::Index>(units.size()));
  for (std::size_t i = 0; i < units.size(); ++i) {
    std::vector<double> above = units;
    std::vector<double> below = units;
    above[i] = std::min(units[i] + kScrewDifference, 1.0);
    below[i] = std::max(units[i] - kScrewDifference, 0.0);
    change[static_cast<Eigen::Index>(i)] =
        (lost_motion(set.with_units(current_, above), problem_.axis()) -
         lost_motion(set.with_units(current_, below), problem_.axis())) /
        (above[i] - below[i]);
  }
  return change;
}

/// Deviation of the lost motion, with what is held and what the model lacks [um].
///
/// The lost motion B takes the place of the play among the parameters: with its changes g by them,
/// the derivatives by the others at a given B are J_i - J_b g_i / g_b, and that by B is J_b / g_b.
/// @param indices  parameters that were fitted, the play as the last
double AxisFitter::lost_motion_deviation(const Indices& indices, const Indices& held) {
  const Eigen::VectorXd g = lost_motion_by(indices);
  Eigen::MatrixXd j = derivatives(indices);
  const Eigen::Index play = g.size() - 1;
  const Eigen::VectorXd by_lost_motion = j.col(play) / g[play];
  for (Eigen::Index i = 0; i < play; ++i) {
    j.col(i) -= by_lost_motion * g[i];
  }
  j.col(play) = by_lost_motion;
  const Eigen::VectorXd residual = problem_.residuals(current_);
  const auto block = static_cast<Eigen::Index>(std::lround(AxisProblem::kBlock / current_.period));
  double square = block_covariance(j, residual, block)(play, play);
  const Eigen::MatrixXd inverse = normal_inverse(j);
  const auto move_by = [&](const Eigen::VectorXd& change) {
    const Eigen::VectorXd product = transposed_product(j, change);
    return inverse.row(play).dot(product);
  };
  const std::vector<Eigen::VectorXd> roundings = problem_.rounding_errors();
  for (const Eigen::VectorXd& rounding : roundings) {
    square += std::pow(move_by(rounding), 2) / static_cast<double>(roundings.size());
  }
  square *= std::pow(widening(), 2);
  if (!held.empty()) {
    const Eigen::MatrixXd of_held = derivatives(held);
    const std::vector<double> values = set_of(held).values(current_);
    for (std::size_t i = 0; i < held.size(); ++i) {
      const Searched& one = searched_[held[i]];
      const double size = std::max(std::abs(values[i]), std::abs(one.result.start));
      const double doubt = kDoubtOfHeld * size / value_per_unit(one.candidate, size);
      square += std::pow(move_by(of_held.col(static_cast<Eigen::Index>(i))) * doubt, 2);
    }
  }
  double of_features = 0.0;
  for (const FeatureDoubt& feature : feature_doubts(j)) {
    of_features = std::max(of_features, feature.spread[play]);
  }
  return std::sqrt(square + of_features * of_features);
}

/// The lost motion. It shows where play and stretch by friction do not apart.
void AxisFitter::derive_lost_motion() {
  Indices fitted;
  Indices held;
  std::size_t play = searched_.size();
  for (std::size_t i = 0; i < searched_.size(); ++i) {
    const Searched& parameter = searched_[i];
    const Verdict verdict = parameter.result.verdict;
    if (parameter.result.key.ends_with("screw_backlash_um") && verdict != Verdict::kFixed) {
      play = i;
    } else if (verdict == Verdict::kIdentified || verdict == Verdict::kUncertain ||
               parameter.result.key.ends_with("screw_stiffness_N_per_um")) {
      fitted.push_back(i);
    } else if (verdict != Verdict::kFixed && !parameter.candidate.is_analysed_only) {
      held.push_back(i);
    }
  }
  const bool has_both = std::ranges::any_of(problem_.records(), [](const AxisRecord& record) {
    return record.has_scale() || !record.is_at_table;
  });
  if (play == searched_.size() || !problem_.shows_table() || !has_both) {
    return;
  }
  fitted.push_back(play);
  FittedParameter lost;
  lost.name = "lost motion [um]";
  lost.value = lost_motion(current_, problem_.axis());
  lost.sigma = lost_motion_deviation(fitted, held);
  lost.relative = lost.sigma / std::max(lost.value, kNaturalLostMotion);
  lost.verdict = Verdict::kIdentified;
  if (lost.relative > kMostRelative) {
    lost.verdict = Verdict::kUnidentified;
  } else if (!is_screw_fitted()) {
    lost.verdict = Verdict::kUncertain;
  }
  fit_.derived.push_back(std::move(lost));
}

}  // namespace twin::studies::identify
