#include "hal/mujoco/friction.hpp"

#include <algorithm>
#include <cmath>

namespace twin::hal::mujoco {
namespace {

constexpr double kHarmonicSum = 1.0 + 1.0 / 2.0 + 1.0 / 3.0 + 1.0 / 4.0;

double sign_of(double velocity) noexcept {
  return velocity > 0.0 ? 1.0 : velocity < 0.0 ? -1.0 : 0.0;
}

std::variant<Lugre, CoulombFriction, MaxwellFriction> law_of(const FrictionParams& params,
                                                             double step) noexcept {
  switch (params.law) {
    case FrictionLaw::kCoulomb:
      return CoulombFriction(params, step);
    case FrictionLaw::kMaxwell:
      return MaxwellFriction(params, step);
    case FrictionLaw::kLugre:
      break;
  }
  return Lugre(params, step);
}

}  // namespace

double CoulombFriction::step(double velocity) noexcept {
  force_ = std::clamp(force_ + params_.bristle_stiffness * velocity * step_,
                      -params_.coulomb_at(-1.0), params_.coulomb_at(1.0));
  return force_ + params_.viscous_at(velocity) * velocity;
}

void CoulombFriction::reset(double velocity) noexcept {
  force_ = sign_of(velocity) * params_.coulomb_at(velocity);
}

MaxwellFriction::MaxwellFriction(const FrictionParams& params, double step) noexcept
    : params_(params), step_(step) {}

double MaxwellFriction::stribeck(double velocity) const noexcept {
  const double ratio = velocity / params_.stribeck_velocity;
  return params_.coulomb_at(velocity) *
         (1.0 + (params_.static_ratio - 1.0) * std::exp(-ratio * ratio));
}

double MaxwellFriction::step(double velocity) noexcept {
  const double limit = stribeck(velocity) / kElements;
  const double rate = params_.bristle_stiffness * params_.stribeck_velocity;  // C
  if (velocity * last_velocity_ < 0.0) {
    slips_.fill(false);
  }
  last_velocity_ = velocity != 0.0 ? velocity : last_velocity_;
  double sum = 0.0;
  for (int i = 0; i < kElements; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (slips_[k] && limit > 0.0) {
      // Exact for a constant velocity: F_i tends to sgn(v) g / n with the rate C / g.
      const double share = -std::expm1(-rate * step_ / (kElements * limit));
      force_[k] += share * (sign_of(velocity) * limit - force_[k]);
    } else {
      force_[k] += params_.bristle_stiffness / kHarmonicSum / (i + 1) * velocity * step_;
      slips_[k] = force_[k] * sign_of(velocity) >= limit;
      force_[k] = std::clamp(force_[k], -limit, limit);
    }
    sum += force_[k];
  }
  return sum + params_.viscous_at(velocity) * velocity;
}

void MaxwellFriction::reset(double velocity) noexcept {
  force_.fill(sign_of(velocity) * stribeck(velocity) / kElements);
  slips_.fill(velocity != 0.0);
  last_velocity_ = velocity;
}

Friction::Friction(const FrictionParams& params, double step) noexcept
    : law_(law_of(params, step)) {}

double Friction::step_other(double velocity) noexcept {
  if (auto* const coulomb = std::get_if<CoulombFriction>(&law_)) {
    return coulomb->step(velocity);
  }
  return std::get_if<MaxwellFriction>(&law_)->step(velocity);
}

void Friction::reset(double velocity) noexcept {
  std::visit([velocity](auto& law) { law.reset(velocity); }, law_);
}

}  // namespace twin::hal::mujoco
