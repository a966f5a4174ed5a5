#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "studies/identify/axis_fitter.hpp"
#include "studies/identify/torque_servo.hpp"

// The parts of a fit that are about what its deviations do not say.
namespace twin::studies::identify {
namespace {

constexpr double kTellingShare = 0.1;    // of the variance of a residual
constexpr double kDoubt = 1.5;           // of a deviation, by which it is widened
constexpr double kDoubtPerExcess = 3.0;  // of the residual over what rounding makes

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
                        result.key.ends_with("bristle_damping_N_s_per_m");
    if (scales && !parameter.is_measured && result.verdict == Verdict::kIdentified) {
      result.sigma = std::hypot(result.sigma, mass->result.relative * result.value);
      result.relative = std::hypot(result.relative, mass->result.relative);
    }
  }
}

/// Says what the residual goes with: the share of its variance that a straight line explains.
std::vector<std::string> AxisFitter::what_residual_goes_with() {
  problem_.set_base(current_);
  const Eigen::VectorXd all = problem_.residuals(ParameterSet(), {});
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
    const double excess = std::max(fit_.residual_rms / fit_.rounding_rms - 1.0, 0.0);
    for (Searched& parameter : searched_) {
      FittedParameter& result = parameter.result;
      if (result.verdict == Verdict::kIdentified && !parameter.is_measured) {
        const double wider = kDoubt * (1.0 + kDoubtPerExcess * excess);
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
