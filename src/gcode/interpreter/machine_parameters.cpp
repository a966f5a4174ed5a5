#include "gcode/interpreter/machine_parameters.hpp"

#include <array>

#include "core/units.hpp"
#include "gcode/interpreter/interpreter.hpp"
#include "gcode/interpreter/set_up.hpp"

namespace twin::gcode {
namespace {

/// A predefined name and its value; source: LinuxCNC, "G-code overview", predefined named
/// parameters.
struct PredefinedName {
  std::string_view name;
  double (*value)(const ModalState& state, const Vec3& position);
};

double in_units(const ModalState& state, double length) { return length / state.unit; }
double as_number(bool is_true) { return is_true ? 1.0 : 0.0; }

constexpr std::array kPredefined = {
    PredefinedName{"_x", [](const ModalState& s, const Vec3& p) { return in_units(s, p.x()); }},
    PredefinedName{"_y", [](const ModalState& s, const Vec3& p) { return in_units(s, p.y()); }},
    PredefinedName{"_z", [](const ModalState& s, const Vec3& p) { return in_units(s, p.z()); }},
    PredefinedName{"_metric",
                   [](const ModalState& s, const Vec3&) { return s.unit == 1.0 ? 1.0 : 0.0; }},
    PredefinedName{"_imperial",
                   [](const ModalState& s, const Vec3&) { return s.unit == 1.0 ? 0.0 : 1.0; }},
    PredefinedName{"_absolute",
                   [](const ModalState& s, const Vec3&) { return s.is_incremental ? 0.0 : 1.0; }},
    PredefinedName{"_incremental",
                   [](const ModalState& s, const Vec3&) { return s.is_incremental ? 1.0 : 0.0; }},
    PredefinedName{"_feed",
                   [](const ModalState& s, const Vec3&) {
                     return in_units(s, units::mm_per_min_from_mm_per_s(s.feedrate));
                   }},
    PredefinedName{"_inverse_time",
                   [](const ModalState& s, const Vec3&) {
                     return as_number(s.feed_mode == FeedMode::kInverseTime);
                   }},
    PredefinedName{"_units_per_minute",
                   [](const ModalState& s, const Vec3&) {
                     return as_number(s.feed_mode == FeedMode::kPerMinute);
                   }},
    PredefinedName{"_units_per_rev",
                   [](const ModalState& s, const Vec3&) {
                     return as_number(s.feed_mode == FeedMode::kPerRevolution);
                   }},
    PredefinedName{"_retract_r_plane", [](const ModalState& s,
                                          const Vec3&) { return as_number(s.returns_to_retract); }},
    PredefinedName{"_retract_old_z", [](const ModalState& s,
                                        const Vec3&) { return as_number(!s.returns_to_retract); }},
    PredefinedName{"_spindle_css_mode",
                   [](const ModalState& s, const Vec3&) { return as_number(s.has_surface_speed); }},
    PredefinedName{
        "_spindle_rpm_mode",
        [](const ModalState& s, const Vec3&) { return as_number(!s.has_surface_speed); }},
    PredefinedName{
        "_ijk_absolute_mode",
        [](const ModalState& s, const Vec3&) { return as_number(s.has_absolute_centres); }},
    PredefinedName{"_plane",
                   [](const ModalState& s, const Vec3&) {
                     return s.plane == Plane::kXy ? 170.0 : s.plane == Plane::kZx ? 180.0 : 190.0;
                   }},
    PredefinedName{"_rpm", [](const ModalState& s, const Vec3&) { return s.spindle_rpm; }},
    PredefinedName{"_lathe_diameter_mode", [](const ModalState&, const Vec3&) { return 0.0; }},
    PredefinedName{"_lathe_radius_mode", [](const ModalState&, const Vec3&) { return 1.0; }},
    PredefinedName{"_task", [](const ModalState&, const Vec3&) { return 1.0; }},
    PredefinedName{"_remap_level", [](const ModalState&, const Vec3&) { return 0.0; }},
    PredefinedName{"_vmajor", [](const ModalState&, const Vec3&) { return 2.9; }},
    PredefinedName{"_vminor", [](const ModalState&, const Vec3&) { return 0.0; }},
};

constexpr int kPosition = 5420;  // X; Y and Z follow

/// 540 for G54 to 593 for G59.3, 541 for the further ones.
double number_of_system(std::size_t system) {
  if (system >= Coordinates::kSystems) {
    return 541.0;
  }
  return system < 6 ? 540.0 + 10.0 * static_cast<double>(system)
                    : 585.0 + static_cast<double>(system);
}

}  // namespace

std::optional<double> MachineParameters::numbered(int number) const {
  if (number < kPosition || number > kPosition + 2) {
    return interpreter_->set_up().parameter(number);
  }
  return in_units(interpreter_->state(), interpreter_->position()[number - kPosition]);
}

std::optional<double> MachineParameters::named(std::string_view name) const {
  for (const PredefinedName& known : kPredefined) {
    if (known.name == name) {
      return known.value(interpreter_->state(), interpreter_->position());
    }
  }
  const SetUp& set_up = interpreter_->set_up();
  if (name == "_current_tool") {
    return set_up.tool();
  }
  if (name == "_selected_tool") {
    return set_up.selected_tool();
  }
  if (name == "_coord_system") {
    return number_of_system(set_up.coordinates().selected());
  }
  return std::nullopt;
}

bool MachineParameters::set(int number, double value) {
  return interpreter_->set_up().set_parameter(number, value);
}

}  // namespace twin::gcode
