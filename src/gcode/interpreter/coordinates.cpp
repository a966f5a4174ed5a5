#include "gcode/interpreter/coordinates.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace twin::gcode {
namespace {

constexpr int kShiftSwitch = 5210;
constexpr int kShift = 5211;  // X; Y and Z follow
constexpr int kSelected = 5220;
constexpr int kFirstSystem = 5221;  // X of G54
constexpr int kPerSystem = 20;
constexpr int kRotation = 9;  // of a system, behind its X

Vec3 through(const Overlay& overlay, const Vec3& place) {
  return overlay.is_on ? Vec3(overlay.centre + overlay.turn * (place - overlay.centre)) : place;
}

/// Sine and cosine with the exact values at multiples of a right angle.
void sine_and_cosine(double angle_deg, double& sine, double& cosine) {
  const double turn = std::remainder(angle_deg, 360.0);
  const double quarter = turn / 90.0;
  if (quarter == std::round(quarter)) {
    const int quarters = static_cast<int>(quarter);
    sine = quarters == 1 ? 1.0 : (quarters == -1 ? -1.0 : 0.0);
    cosine = quarters == 0 ? 1.0 : (std::abs(quarters) == 2 ? -1.0 : 0.0);
    return;
  }
  const double angle = turn * std::numbers::pi / 180.0;
  sine = std::sin(angle);
  cosine = std::cos(angle);
}

}  // namespace

Eigen::Matrix3d rotation_about(int axis, double angle_deg) {
  double sine = 0.0;
  double cosine = 1.0;
  sine_and_cosine(angle_deg, sine, cosine);
  const int first = (axis + 1) % 3;
  const int second = (axis + 2) % 3;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(first, first) = matrix(second, second) = cosine;
  matrix(first, second) = -sine;
  matrix(second, first) = sine;
  return matrix;
}

void Coordinates::place_workpiece(const Vec3& placement) {
  placement_ = placement;
  update();
}

Vec3 Coordinates::machine_of(const Vec3& program) const noexcept {
  if (is_identity_) {
    return program;
  }
  return is_shift_only_ ? Vec3(program + b_) : Vec3(a_ * program + b_);
}

Vec3 Coordinates::program_of(const Vec3& machine) const noexcept {
  if (is_identity_) {
    return machine;
  }
  return is_shift_only_ ? Vec3(machine - b_) : Vec3(inverse_ * (machine - b_));
}

geometry::Arc Coordinates::machine_arc(const geometry::Arc& arc) const {
  geometry::Arc placed = arc;
  placed.centre = machine_of(arc.centre);
  if (is_shift_only_) {
    return placed;
  }
  placed.e1 = a_ * arc.e1 / factor_;
  placed.e2 = a_ * arc.e2 / factor_;
  placed.radius = arc.radius * factor_;
  placed.radius_change = arc.radius_change * factor_;
  placed.rise = is_mirrored_ ? -arc.rise * factor_ : arc.rise * factor_;
  return placed;
}

void Coordinates::select(std::size_t system) {
  selected_ = system;
  active_ = stored_[system];
  update();
}

const WorkOffset& Coordinates::stored(std::size_t system) const { return stored_[system]; }

void Coordinates::store(std::size_t system, const WorkOffset& offset) {
  stored_[system] = offset;
  if (system == selected_) {
    select(system);
  }
}

void Coordinates::set_shift(const Vec3& shift, bool is_on) {
  shift_ = shift;
  is_shift_on_ = is_on;
  update();
}

void Coordinates::set_tool(const Vec3& offset) {
  tool_ = offset;
  update();
}

void Coordinates::set_rotation(const Overlay& rotation) {
  rotation_ = rotation;
  update();
}

void Coordinates::set_scaling(const Overlay& scaling) {
  scaling_ = scaling;
  update();
}

Vec3 Coordinates::origin_for(std::size_t system, const Vec3& machine,
                             const std::function<void(Vec3&)>& change) const {
  const WorkOffset& offset = stored_[system];
  const Eigen::Matrix3d turn = rotation_about(2, offset.rotation_deg);
  const Vec3 shift = is_shift_on_ ? shift_ : Vec3(Vec3::Zero());
  const Vec3 beside = machine - tool_ - placement_;
  Vec3 place = turn.transpose() * (beside - offset.origin) - shift;
  change(place);
  return beside - turn * (place + shift);
}

Vec3 Coordinates::fixture_place(const Vec3& machine) const {
  const WorkOffset& fixture = stored_[kSystems - 1];
  return rotation_about(2, fixture.rotation_deg).transpose() *
         (machine - placement_ - fixture.origin);
}

void Coordinates::update() {
  const Eigen::Matrix3d a_before = a_;
  const Vec3 b_before = b_;
  const Eigen::Matrix3d turn = rotation_about(2, active_.rotation_deg);
  a_ = turn;
  if (rotation_.is_on) {
    a_ = a_ * rotation_.turn;
  }
  if (scaling_.is_on) {
    a_ = a_ * scaling_.turn;
  }
  Vec3 local = through(rotation_, through(scaling_, Vec3::Zero()));
  if (is_shift_on_) {
    local += shift_;
  }
  b_ = active_.origin + turn * local + tool_ + placement_;
  is_shift_only_ = a_ == Eigen::Matrix3d::Identity();
  is_identity_ = is_shift_only_ && b_ == Vec3::Zero();
  const double determinant = a_.determinant();
  factor_ = scaling_.is_on ? std::cbrt(std::abs(determinant)) : 1.0;
  is_mirrored_ = determinant < 0.0;
  inverse_ = a_.transpose() / (factor_ * factor_);
  version_ += a_ == a_before && b_ == b_before ? 0 : 1;
}

std::optional<double> Coordinates::parameter(int number) const {
  if (number == kShiftSwitch) {
    return is_shift_on_ ? 1.0 : 0.0;
  }
  if (number >= kShift && number < kShift + 3) {
    return shift_[number - kShift];
  }
  if (number == kSelected) {
    return static_cast<double>(selected_ + 1);
  }
  const int place = number - kFirstSystem;
  const auto system = static_cast<std::size_t>(place / kPerSystem);
  if (place < 0 || system >= kSystems) {
    return std::nullopt;
  }
  const int axis = place % kPerSystem;
  if (axis < 3) {
    return stored_[system].origin[axis];
  }
  return axis == kRotation ? std::optional<double>(stored_[system].rotation_deg) : std::nullopt;
}

bool Coordinates::set_parameter(int number, double value) {
  if (!parameter(number) || number == kSelected) {
    return false;
  }
  if (number == kShiftSwitch) {
    set_shift(shift_, value != 0.0);
  } else if (number < kShift + 3) {
    shift_[number - kShift] = value;
    update();
  } else {
    const int place = number - kFirstSystem;
    WorkOffset& offset = stored_[static_cast<std::size_t>(place / kPerSystem)];
    const int axis = place % kPerSystem;
    (axis < 3 ? offset.origin[axis] : offset.rotation_deg) = value;
  }
  return true;
}

}  // namespace twin::gcode
