#include "shadow/force_balance.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace twin::shadow {
namespace {

constexpr double kPerPeriod = 0.2;   // bandwidth of the filter times the period
constexpr double kFastest = 200.0;   // largest bandwidth [rad/s]
constexpr double kStandstill = 0.5;  // speed below which sgn(v) has no value [mm/s]

std::size_t index_of(Cause cause) noexcept { return static_cast<std::size_t>(cause); }

}  // namespace

ForceBalance::ForceBalance(const hal::mujoco::AxisParams& params, double period) noexcept
    : params_(params), period_(period), omega_(std::min(kPerPeriod / period, kFastest)) {}

void ForceBalance::begin(double measured, double force) noexcept {
  place_ = {.value = measured};
  force_ = {.value = force};
}

void ForceBalance::pass(double input, Filtered& state) const noexcept {
  state.acceleration = omega_ * (omega_ * (input - state.value) - 2.0 * state.rate);
  state.rate += period_ * state.acceleration;
  state.value += period_ * state.rate;
}

SignalRow ForceBalance::step(double measured, double force) noexcept {
  pass(measured, place_);
  pass(force, force_);
  const double v = place_.rate;
  const double sliding = std::clamp(v / kStandstill, -1.0, 1.0) * params_.friction.coulomb_at(v);
  const double mass = params_.moving_mass + params_.rotor_mass();
  const double friction = sliding + params_.friction.viscous_at(v) * v;
  const double acceleration = units::m_from_mm(place_.acceleration);
  const double needed = mass * acceleration + friction + params_.load.weight;
  SignalRow row;
  row.residual = force_.value - needed;
  row.signature[index_of(Cause::kFriction)] = friction;
  row.signature[index_of(Cause::kInertia)] = acceleration;
  row.signature[index_of(Cause::kForce)] = -1.0;
  const bool is_torque_mode = params_.drive.mode == hal::mujoco::DriveMode::kTorque;
  if (is_torque_mode) {
    row.signature[index_of(Cause::kVrefGain)] = -needed;
  } else {
    row.signature[index_of(Cause::kMotorForce)] = needed;
  }
  return row;
}

}  // namespace twin::shadow
