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
  for (const Change& change : params.changes) {
    const AxisParams& changed = params.axis[change.axis];
    const double movable = changed.moving_mass + changed.rotor_mass();
    if (change.kind == ChangeKind::kLoad && change.value >= movable) {
      return fail(ErrorCode::kUsage,
                  fmt::format("change '{}': the load must be below the {:.3g} kg that the axis "
                              "moves",
                              to_string(change), movable));
    }
    if (needs_screw(change.kind) && !physics->has_screw(change.axis)) {
      return fail(ErrorCode::kUsage, fmt::format("change '{}' needs screws that give: --set "
                                                 "table.model=xy_table_compliant.xml",
                                                 to_string(change)));
    }
  }
  return std::unique_ptr<TablePlant>(new TablePlant(std::move(physics), params, step, steps));
}

TablePlant::TablePlant(std::unique_ptr<TablePhysics> physics, const TableParams& params,
                       double step, int steps)
    : physics_(std::move(physics)), changes_(params.changes), step_(step), steps_(steps) {
  for (const AxisParams& axis : params.axis) {
    axes_.emplace_back(axis, step_);
    feedback_.emplace_back(axis.encoder.delay / step_);
    if (!changes_.empty()) {
      changing_.push_back(
          {.now = {}, .edges = Encoder(axis.encoder), .mm_per_count = axis.encoder.mm_per_count});
    }
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

void TablePlant::change(std::size_t axis) noexcept {
  Changing& changing = changing_[axis];
  if (changing.ready_at < 0.0) {
    if (!is_ready(axis)) {
      return;
    }
    changing.ready_at = time();
  }
  changing.now = condition_at(changes_, axis, time() - changing.ready_at);
  axes_[axis].set_condition(changing.now);
  physics_->set_condition(axis, changing.now);
}

/// A lost edge moves the encoder's zero by a count, against the motion.
double TablePlant::with_lost_edges(std::size_t axis, double position) noexcept {
  Changing& changing = changing_[axis];
  const std::int64_t counts = changing.edges.counts(position);
  const std::int64_t edges = counts - std::exchange(changing.counts, counts);
  if (edges != 0 && changing.now.lost_share > 0.0) {
    changing.passed += changing.now.lost_share * static_cast<double>(std::abs(edges));
    const double lost = std::floor(changing.passed);
    changing.passed -= lost;
    changing.lost += (edges > 0 ? lost : -lost) * changing.mm_per_count;
  }
  return position - changing.lost;
}

void TablePlant::step() {
  const double now = time();
  for (std::size_t axis = 0; axis < changing_.size(); ++axis) {
    change(axis);
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    AxisForces forces = axes_[axis].step(physics_->motion(axis), now);
    forces.slide += external_force_[axis];
    physics_->apply(axis, forces);
  }
  physics_->pull_pen(pen_reference_);
  physics_->step();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    reported_[axis] = feedback_[axis].step(physics_->encoder_position(axis));
    if (!changing_.empty()) {
      reported_[axis] = with_lost_edges(axis, reported_[axis]);
    }
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
