#include "studies/identify/lacking_features.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/linear_algebra.hpp"
#include "studies/identify/least_squares.hpp"

namespace twin::studies::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFeatureTime = 0.5e-3;  // of delays, lags and sampling in unit strength [s]
constexpr double kFrictionShare = 0.1;   // of the friction, in unit strength
constexpr double kPhaseLag = 0.1;        // in unit strength, at the gain of the velocity loop [rad]
// Usual strengths, where nothing shows them: one in the loop of a drive, 1 ms before it, 2 ms in
// what reads an encoder, 20 % of the friction.
constexpr double kOfDrives = 1.0;
constexpr double kOfInputs = 2.0;
constexpr double kOfEncoders = 4.0;
constexpr double kOfFriction = 2.0;
constexpr double kTrusted = 0.01;       // of a signature; less of its own is no linear effect
constexpr double kLeastForce = 0.1;     // [N]
constexpr double kLeastViscous = 1e-3;  // [N s/mm]

}  // namespace

std::vector<LackingFeature> lacking_features(const config::MachineFile& fitted, hal::Axis axis,
                                             bool has_volts) {
  using hal::mujoco::AxisParams;
  std::vector<LackingFeature> features;
  const auto add = [&](const char* name, double usual, const auto&... changes) {
    LackingFeature& feature = features.emplace_back(LackingFeature{name, usual, {}});
    const auto one = [&](const auto& change) {
      config::MachineFile& machine = feature.machines.emplace_back(fitted);
      change(machine.table.axis[axis]);
    };
    (one(changes), ...);
  };
  const AxisParams& params = fitted.table.axis[axis];
  const double coulomb = kFrictionShare * std::max(params.friction.coulomb, kLeastForce);
  const double viscous = kFrictionShare * std::max(params.friction.viscous, kLeastViscous);
  // A velocity loop that works has not much more phase lag than this.
  const double in_loop =
      std::min(kFeatureTime, kPhaseLag / (2.0 * std::numbers::pi * params.drive.velocity_gain_Hz));
  add("a dead time of the speed feedback", kOfDrives,
      [=](AxisParams& p) { p.drive.speed_delay += in_loop; });
  add("a sampled velocity loop", kOfDrives,
      [=](AxisParams& p) { p.drive.velocity_loop_period += 2.0 * in_loop; });
  add("a filter of the speed feedback", kOfDrives,
      [=](AxisParams& p) { p.drive.speed_filter += in_loop; });
  add("an input filter", kOfInputs, [](AxisParams& p) { p.drive.input_lag += kFeatureTime; });
  add("a dead time of the position feedback", kOfEncoders,
      [](AxisParams& p) { p.encoder.delay += kFeatureTime; });
  add("Coulomb friction that differs either way", kOfFriction,
      [=](AxisParams& p) { p.friction.coulomb_asymmetry += coulomb; });
  add("viscous friction that differs either way", kOfFriction,
      [=](AxisParams& p) { p.friction.viscous_asymmetry += viscous; });
  add("weight", kOfFriction, [=](AxisParams& p) { p.load.weight += coulomb; });
  add(
      "torque ripple", kOfFriction, [=](AxisParams& p) { p.load.ripple_amplitude = coulomb; },
      [=](AxisParams& p) {
        p.load.ripple_amplitude = coulomb;
        p.load.ripple_phase += 0.5 * std::numbers::pi;
      });
  if (params.friction.law == hal::mujoco::FrictionLaw::kLugre) {
    add("generalised Maxwell slip", 1.0,
        [](AxisParams& p) { p.friction.law = hal::mujoco::FrictionLaw::kMaxwell; });
    add("plain LuGre friction", 1.0, [](AxisParams& p) { p.friction.elastic_share = 0.0; });
  }
  if (!has_volts) {
    LackingFeature& late =
        features.emplace_back(LackingFeature{"a dead time of the command", kOfEncoders, {}});
    late.machines.push_back(fitted);
    late.machines.front().servo[axis].command_delay += kFeatureTime;
  }
  return features;
}

FeatureDoubt feature_doubt(const MatrixXd& jacobian, const VectorXd& residual,
                           const MatrixXd& signature, double usual_strength, Index block) {
  if (!(signature.squaredNorm() > 0.0)) {
    return {.name = {}, .spread = VectorXd::Zero(jacobian.cols())};  // too short for a physics step
  }
  const MatrixXd inverse = normal_inverse(jacobian);
  const MatrixXd moves = transposed_product(inverse, transposed_product(jacobian, signature));  // S
  const MatrixXd own = signature - jacobian.lazyProduct(moves);  // Dp
  const VectorXd rest = residual - jacobian.lazyProduct(transposed_product(
                                       inverse, transposed_product(jacobian, residual)));
  MatrixXd covariance = block_covariance(own, rest, block);
  for (Index i = 0; i < signature.cols(); ++i) {
    covariance(i, i) += std::pow(
        usual_strength * kTrusted * signature.col(i).norm() / std::max(own.col(i).norm(), 1e-300),
        2);
  }
  // The estimate and what is usual, each with its deviation, make the strength.
  const Index n = signature.cols();
  const MatrixXd usual = MatrixXd::Identity(n, n) * (usual_strength * usual_strength);
  const VectorXd estimate = -transposed_product(normal_inverse(own), transposed_product(own, rest));
  const MatrixXd both = covariance + usual;
  const VectorXd strength = usual * solve_symmetric(both, estimate);
  const MatrixXd left = covariance * solve_symmetric(both, usual);
  FeatureDoubt doubt;
  doubt.spread =
      ((moves * strength).cwiseAbs2() + (moves * left * moves.transpose()).diagonal().cwiseMax(0.0))
          .cwiseSqrt();
  doubt.share = 1.0 - (rest + own * estimate).squaredNorm() / std::max(rest.squaredNorm(), 1e-300);
  return doubt;
}

}  // namespace twin::studies::identify
