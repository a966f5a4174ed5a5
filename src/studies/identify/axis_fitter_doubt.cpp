#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel_for.hpp"
#include "studies/identify/axis_fitter.hpp"
#include "studies/identify/lacking_features.hpp"
#include "studies/identify/torque_servo.hpp"

// The parts of a fit that are about what its deviations do not say.
namespace twin::studies::identify {
namespace {

constexpr double kFeatureDifference = 1e-4;  // of the unit cube
constexpr double kTellingShare = 0.1;        // of the variance of a residual
constexpr double kDoubt = 1.5;               // of a deviation, by which it is widened
constexpr double kDoubtPerExcess = 3.0;      // of the residual over what rounding makes

}  // namespace

/// Friction is found relative to the mass: a deviation of the mass by the force is one of friction.
void AxisFitter::widen_by_mass() {
  const auto mass = std::ranges::find_if(searched_, [](const Searched& p) {
    return p.result.key.ends_with("moving_mass_kg") && p.is_measured;
  });
  if (mass == searched_.end()) {
    return;
  }
  for (Searched& parameter : searched_) {
    FittedParameter& result = parameter.result;
    const bool scales = result.key.ends_with("coulomb_friction_N") ||
                        result.key.ends_with("viscous_friction_N_s_per_m") ||
                        result.key.ends_with("bristle_stiffness_N_per_um") ||
                        result.key.ends_with("bristle_damping_N_s_per_m") ||
                        result.key.ends_with("screw_stiffness_N_per_um") ||
                        result.key.ends_with("screw_damping_N_s_per_m");
    if (scales && !parameter.is_measured && result.verdict == Verdict::kIdentified) {
      result.sigma = std::hypot(result.sigma, mass->result.relative * result.value);
      result.relative = std::hypot(result.relative, mass->result.relative);
    }
  }
}

/// Derivatives of the residual by parameters in their ranges, at the fit.
Eigen::MatrixXd AxisFitter::derivatives(const Indices& indices) {
  problem_.set_base(current_);
  const ParameterSet set = set_of(indices);
  const std::vector<double> units = set.units(current_);
  return central_jacobian(
      [&](const Eigen::VectorXd& u) { return residuals(set, u); },
      Eigen::Map<const Eigen::VectorXd>(units.data(), static_cast<Eigen::Index>(units.size())),
      kFeatureDifference);
}

/// How much wider deviations to first order are to be: by as much as the residual is larger than
/// what rounding makes, and by kDoubt at least.
double AxisFitter::widening() const {
  const double excess =
      fit_.rounding_rms > 0.0 ? std::max(fit_.residual_rms / fit_.rounding_rms - 1.0, 0.0) : 0.0;
  return kDoubt * (1.0 + kDoubtPerExcess * excess);
}

/// What each feature that no search fits would move parameters of these derivatives by.
std::vector<FeatureDoubt> AxisFitter::feature_doubts(const Eigen::MatrixXd& j) {
  const Eigen::VectorXd residual = problem_.residuals(current_);
  const std::vector<LackingFeature> features =
      lacking_features(current_, problem_.axis(), has_volts());
  std::vector<FeatureDoubt> doubts(features.size());
  const auto block = static_cast<Eigen::Index>(std::lround(AxisProblem::kBlock / current_.period));
  parallel_for(features.size(), [&](std::size_t i) {
    const auto& machines = features[i].machines;
    Eigen::MatrixXd signature(residual.size(), static_cast<Eigen::Index>(machines.size()));
    for (std::size_t k = 0; k < machines.size(); ++k) {
      signature.col(static_cast<Eigen::Index>(k)) = problem_.residuals(machines[k]) - residual;
    }
    doubts[i] = feature_doubt(j, residual, signature, features[i].usual, block);
    doubts[i].name = features[i].name;
  });
  return doubts;
}

/// Adds to the deviations what the parameters would move by if the model had one of the features
/// that no search fits: the largest move of all.
void AxisFitter::doubt_by_lacking_features() {
  Indices indices;
  for (std::size_t i = 0; i < searched_.size(); ++i) {
    const Verdict verdict = searched_[i].result.verdict;
    if ((verdict == Verdict::kIdentified || verdict == Verdict::kUncertain) &&
        !searched_[i].is_measured) {
      indices.push_back(i);
    }
  }
  if (indices.empty()) {
    return;
  }
  const std::vector<FeatureDoubt> doubts = feature_doubts(derivatives(indices));
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const FeatureDoubt& most = *std::ranges::max_element(
        doubts, {}, [row](const FeatureDoubt& doubt) { return doubt.spread[row]; });
    const Searched& parameter = searched_[indices[k]];
    FittedParameter& result = searched_[indices[k]].result;
    const double per_sigma = result.sigma > 0.0 ? result.relative / result.sigma : 0.0;
    result.sigma = std::hypot(result.sigma,
                              most.spread[row] * value_per_unit(parameter.candidate, result.value));
    result.relative = result.sigma * per_sigma;
    if (result.relative > kMostRelative && result.verdict == Verdict::kIdentified) {
      result.verdict = Verdict::kUncertain;
      result.why = most.name + " would look the same";
    }
  }
  if (fit_.rounding_rms > 0.0 && fit_.residual_rms <= kLackOfFit * fit_.rounding_rms) {
    return;
  }
  const FeatureDoubt& likely = *std::ranges::max_element(doubts, {}, &FeatureDoubt::share);
  if (likely.share > kTellingShare) {
    fit_.would_explain =
        fmt::format("{} would explain {:.0f} % of it", likely.name, 100.0 * likely.share);
  }
}

/// Says what the residual goes with: the share of its variance that a straight line explains.
std::vector<std::string> AxisFitter::what_residual_goes_with() {
  problem_.set_base(current_);
  const Eigen::VectorXd all = problem_.residuals(current_).head(problem_.rows());
  using Cause = std::pair<const char*, double (*)(const motion::Reference&)>;
  constexpr std::array kCauses{
      Cause{"velocity", [](const motion::Reference& r) { return r.velocity; }},
      Cause{"direction",
            [](const motion::Reference& r) {
              return r.velocity > 0.0 ? 1.0 : r.velocity < 0.0 ? -1.0 : 0.0;
            }},
      Cause{"acceleration", [](const motion::Reference& r) { return r.acceleration; }},
      Cause{"position", [](const motion::Reference& r) { return r.position; }}};
  std::vector<std::string> said;
  for (const auto& [name, value] : kCauses) {
    Eigen::VectorXd cause(all.size());
    Eigen::Index row = 0;
    for (const AxisRecord& record : problem_.records()) {
      for (const motion::Reference& r : record.command) {
        cause[row++] = value(r);
      }
    }
    cause.array() -= cause.mean();
    const double product = cause.dot(all);
    const double share =
        product * product / std::max(cause.squaredNorm() * all.squaredNorm(), 1e-300);
    if (share > kTellingShare) {
      said.push_back(fmt::format("{} {:.0f} %", name, 100.0 * share));
    }
  }
  return said;
}

/// Where the residual is far above what rounding makes, the model lacks something: what was fitted
/// by it is uncertain, however small its deviation.
///
/// Below that it widens the deviations: by as much as the residual is larger than what rounding
/// makes, and by kDoubt at least, which is what deviations to first order leave out.
void AxisFitter::judge_lack_of_fit() {
  if (fit_.rounding_rms > 0.0 && fit_.residual_rms <= kLackOfFit * fit_.rounding_rms) {
    const double wider = widening();
    for (Searched& parameter : searched_) {
      FittedParameter& result = parameter.result;
      if (result.verdict == Verdict::kIdentified && !parameter.is_measured) {
        result.sigma *= wider;
        result.relative *= wider;
        if (result.relative > kMostRelative) {
          result.verdict = Verdict::kUncertain;
        }
      }
    }
    return;
  }
  fit_.seems_to_lack = what_residual_goes_with();
  for (Searched& parameter : searched_) {
    FittedParameter& result = parameter.result;
    if (result.verdict == Verdict::kIdentified && !parameter.is_measured) {
      result.verdict = Verdict::kUncertain;
      result.sigma *= kLackOfFit;
      result.relative *= kLackOfFit;
    }
  }
}

/// Without drive commands servo and drive are told apart by transients only, in which anything that
/// the model lacks shows, too: nothing is certain but the steady lag.
void AxisFitter::doubt_gains_without_volts() {
  for (Searched& parameter : searched_) {
    FittedParameter& result = parameter.result;
    if (result.verdict == Verdict::kIdentified && !parameter.is_measured) {
      result.verdict = Verdict::kUncertain;
      if (result.key.ends_with("kp_per_s") || result.key.ends_with(".kf")) {
        result.why = "without drive commands only (1 - Kf) / Kp is shown";
      }
    }
  }
  FittedParameter lag = measure_velocity_lag(problem_);
  lag.name = "(1 - Kf) / Kp [ms]";
  fit_.derived.push_back(std::move(lag));
}

}  // namespace twin::studies::identify
