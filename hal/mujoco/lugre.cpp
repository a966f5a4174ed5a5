#include "hal/mujoco/lugre.hpp"

#include <cmath>
#include <numbers>

namespace twin::hal::mujoco {
namespace {

constexpr double kFastPower = 45.0;   // beyond it 1 + 9 exp(-power) is 1 to the last digit
constexpr double kSmallDecay = 1e-6;  // lambda h below which the exponential is its first term

}  // namespace

Lugre::Lugre(const FrictionParams& params, double step) noexcept
    : params_(params),
      step_(step),
      breakaway_(params.elastic_share * params.coulomb / params.bristle_stiffness) {}

double Lugre::stribeck(double velocity) const noexcept {
  const double ratio = velocity / params_.stribeck_velocity;
  const double power = ratio * ratio;
  if (power > kFastPower) {
    return params_.coulomb_at(velocity);
  }
  return params_.coulomb_at(velocity) * (1.0 + (params_.static_ratio - 1.0) * std::exp(-power));
}

double Lugre::plastic_share(double velocity, double steady) const noexcept {
  if (breakaway_ <= 0.0) {
    return 1.0;
  }
  const double z = std::abs(deflection_);
  if (z >= steady && velocity * deflection_ > 0.0) {
    return 1.0;
  }
  if (z <= breakaway_ || velocity * deflection_ <= 0.0) {
    return 0.0;
  }
  const double middle = 0.5 * (steady + breakaway_);
  return 0.5 + 0.5 * std::sin(std::numbers::pi * (z - middle) / (steady - breakaway_));
}

void Lugre::reset(double velocity) noexcept {
  const double steady = stribeck(velocity) / params_.bristle_stiffness;
  deflection_ = velocity > 0.0 ? steady : velocity < 0.0 ? -steady : 0.0;
}

double Lugre::step(double velocity) noexcept {
  if (params_.coulomb <= 0.0) {
    return params_.viscous_at(velocity) * velocity;
  }
  const double steady = stribeck(velocity) / params_.bristle_stiffness;  // z_ss [mm]
  const double lambda = plastic_share(velocity, steady) * std::abs(velocity) / steady;
  const double decay = lambda * step_;
  double next = deflection_ + velocity * step_;
  if (decay >= kSmallDecay) {
    const double lost = -std::expm1(-decay);  // 1 - E
    next = deflection_ * (1.0 - lost) + velocity * lost / lambda;
  }
  // alpha is taken at the start of the step; a fast slide would jump from the elastic zone past
  // z_ss in one.
  if (std::abs(next) > steady && std::abs(deflection_) <= steady) {
    next = std::copysign(steady, next);
  }
  const double rate = (next - deflection_) / step_;
  deflection_ = next;
  return params_.bristle_stiffness * next + params_.bristle_damping * rate +
         params_.viscous_at(velocity) * velocity;
}

}  // namespace twin::hal::mujoco
