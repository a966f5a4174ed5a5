#include "shadow/response_bank.hpp"

#include <algorithm>

#include "core/units.hpp"
#include "hal/mujoco/table_settings.hpp"

namespace twin::shadow {
namespace {

// Steps of the parameters: large against rounding, small against what bends the response.
constexpr double kFrictionStep = 0.1;
constexpr double kGainStep = 0.02;
constexpr double kLoopGainStep = 0.1;
constexpr double kOffsetStep = 2e-3;    // [V]
constexpr double kInertiaShare = 0.05;  // of the moving mass
constexpr double kBeginning = 1.0;      // force that begins [N]
constexpr double kSteady = 0.2;         // drive command of the motion in which it does [V]
constexpr double kStiffness = 0.5;      // factor; a compliance that is 100 % larger
constexpr double kBacklashStep = 5e-3;  // [mm]

}  // namespace

ResponseBank::ResponseBank(const hal::mujoco::AxisParams& params, double period,
                           double physics_step, bool gives)
    : params_(params),
      period_(period),
      physics_step_(physics_step),
      screw_(gives ? ScrewModel::kGives : ScrewModel::kRigid),
      hum_(params, period, physics_step, hal::mujoco::steps_per_period(period, physics_step)) {
  models_.reserve(kParameters + 2);
  models_.emplace_back(params, period, physics_step, screw_, hal::mujoco::AxisCondition{});
  add(Cause::kFriction, {.friction = 1.0 + kFrictionStep}, kFrictionStep);
  add(Cause::kVrefGain, {.vref_gain = 1.0 + kGainStep}, kGainStep);
  add(Cause::kLoopGain, {.loop_gain = 1.0 + kLoopGainStep}, 1.0 / (1.0 + kLoopGainStep) - 1.0);
  add(Cause::kOffset, {.vref_offset = kOffsetStep}, kOffsetStep);
  const double mass = kInertiaShare * params.moving_mass;
  add(Cause::kInertia, {.mass = mass}, mass);
  if (!gives && !DrivenAxis::can_give(params, period, physics_step)) {
    return;
  }
  std::size_t without_play = 0;
  if (gives) {
    add(Cause::kStiffness, {.stiffness = kStiffness}, 1.0 / kStiffness - 1.0);
  } else {
    screw_ = ScrewModel::kGives;
    without_play = models_.size();
    models_.emplace_back(params, period, physics_step, screw_, hal::mujoco::AxisCondition{});
  }
  add(Cause::kBacklash, {.backlash = kBacklashStep}, kBacklashStep);
  copies_.back().reference = without_play;
}

void ResponseBank::add(Cause cause, const hal::mujoco::AxisCondition& condition, double step) {
  copies_.push_back({cause, models_.size(), 0, step});
  models_.emplace_back(params_, period_, physics_step_, screw_, condition);
}

std::vector<double> ResponseBank::force_response(std::size_t periods) const {
  DrivenAxis with(params_, period_, physics_step_, ScrewModel::kRigid, {.force = kBeginning});
  DrivenAxis without(params_, period_, physics_step_, ScrewModel::kRigid, {});
  with.begin(0.0, kSteady);
  without.begin(0.0, kSteady);
  std::vector<double> response;
  for (std::size_t k = 0; k < periods; ++k) {
    with.advance(0.0);
    without.advance(0.0);
    response.push_back(units::um_from_mm(with.position() - without.position()) / kBeginning);
  }
  return response;
}

void ResponseBank::begin(double measured, double volts) noexcept {
  for (DrivenAxis& model : models_) {
    model.begin(measured, volts);
  }
}

template <class PlaceOf>
void ResponseBank::fill(double measured, PlaceOf&& place_of, SignalRow& row) const noexcept {
  row.residual = units::um_from_mm(measured - place_of(0));
  for (const Copy& copy : copies_) {
    const double by = place_of(copy.model) - place_of(copy.reference);
    row.signature[static_cast<std::size_t>(copy.cause)] = units::um_from_mm(by) / copy.step;
  }
}

SignalRow ResponseBank::slide_row(double scale) const noexcept {
  SignalRow row;
  fill(
      scale, [this](std::size_t model) { return models_[model].slide(); }, row);
  return row;
}

SignalRow ResponseBank::step(double measured, double volts, bool moves) noexcept {
  const std::span<const double> hum = hum_.next_period();
  for (DrivenAxis& model : models_) {
    model.advance(measured, hum);
  }
  SignalRow row;
  fill(
      measured, [this](std::size_t model) { return models_[model].position(); }, row);
  hum_.take(row.residual, moves);
  for (DrivenAxis& model : models_) {
    model.command(volts);
  }
  return row;
}

}  // namespace twin::shadow
