#include "hal/mujoco/table_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "hal/mujoco/table_physics.hpp"
#include "hal/mujoco/table_settings.hpp"

namespace twin::hal::mujoco {

Expected<std::unique_ptr<TablePlant>> TablePlant::open(const TableParams& params, double period) {
  if (!(period > 0.0) || !std::isfinite(period)) {
    return fail(ErrorCode::kMachine, fmt::format("period {} s is not above 0", period));
  }
  TWIN_CHECK(validate(params));
  const int steps = steps_per_period(period, params.physics_step);
  const double step = period / steps;
  TWIN_TRY(std::unique_ptr<TablePhysics> physics, TablePhysics::open(params, step));
  return std::unique_ptr<TablePlant>(new TablePlant(std::move(physics), params, step, steps));
}

TablePlant::TablePlant(std::unique_ptr<TablePhysics> physics, const TableParams& params,
                       double step, int steps)
    : physics_(std::move(physics)), step_(step), steps_(steps) {
  for (const AxisParams& axis : params.axis) {
    axes_.emplace_back(axis, step_);
    feedback_.emplace_back(axis.encoder.delay / step_);
  }
}

TablePlant::~TablePlant() = default;

void TablePlant::command(std::size_t axis, double volts, bool servo_on) noexcept {
  axes_[axis].command(volts, servo_on);
}

void TablePlant::reset_drive(std::size_t axis) noexcept { axes_[axis].reset_drive(); }

void TablePlant::trip(std::size_t axis) noexcept { axes_[axis].trip(); }

void TablePlant::force_limits(std::size_t axis, bool positive, bool negative) noexcept {
  axes_[axis].force_limits(positive, negative);
}

void TablePlant::step() {
  const double now = time();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    AxisForces forces = axes_[axis].step(physics_->motion(axis), now);
    forces.slide += external_force_[axis];
    physics_->apply(axis, forces);
  }
  physics_->pull_pen(pen_reference_);
  physics_->step();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    reported_[axis] = feedback_[axis].step(physics_->encoder_position(axis));
  }
  ++steps_done_;
}

bool TablePlant::advance() noexcept {
  if (is_unstable_ || mujoco_words_[0] != '\0') {
    return false;
  }
  try {
    for (int i = 0; i < steps_; ++i) {
      step();
    }
  } catch (const std::exception& error) {
    const std::string_view text = error.what();
    std::copy_n(text.begin(), std::min(text.size(), mujoco_words_.size() - 1),
                mujoco_words_.begin());
    mujoco_words_[0] = text.empty() ? '?' : mujoco_words_[0];
    return false;
  }
  is_unstable_ = physics_->is_unstable();
  return !is_unstable_;
}

double TablePlant::position(std::size_t axis) const noexcept {
  return physics_->motion(axis).position;
}

double TablePlant::velocity(std::size_t axis) const noexcept {
  return physics_->motion(axis).velocity;
}

double TablePlant::encoder_position(std::size_t axis) const noexcept { return reported_[axis]; }

double TablePlant::pen_position() const noexcept { return physics_->pen_position(); }

bool TablePlant::is_limit_positive(std::size_t axis) const noexcept {
  return axes_[axis].is_limit_positive(position(axis));
}

bool TablePlant::is_limit_negative(std::size_t axis) const noexcept {
  return axes_[axis].is_limit_negative(position(axis));
}

std::string TablePlant::last_error() const {
  if (is_unstable_) {
    return fmt::format(
        "the simulated table became unstable at {:.4f} s; lower table.physics_step_ms or the "
        "gains",
        time());
  }
  if (mujoco_words_[0] != '\0') {
    return fmt::format("MuJoCo stopped at {:.4f} s: {}", time(), mujoco_words_.data());
  }
  return {};
}

}  // namespace twin::hal::mujoco
