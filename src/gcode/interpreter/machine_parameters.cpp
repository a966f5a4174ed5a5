#include "gcode/interpreter/machine_parameters.hpp"

#include <array>

#include "core/units.hpp"
#include "gcode/interpreter/interpreter.hpp"

namespace twin::gcode {
namespace {

/// A predefined name and its value; source: LinuxCNC, "G-code overview", predefined named
/// parameters.
struct PredefinedName {
  std::string_view name;
  double (*value)(const ModalState& state, const Vec3& position);
};

double in_units(const ModalState& state, double length) { return length / state.unit; }

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
};

constexpr int kPosition = 5420;  // X; Y and Z follow

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
  return std::nullopt;
}

bool MachineParameters::set(int number, double value) {
  return interpreter_->set_up().set_parameter(number, value);
}

}  // namespace twin::gcode
