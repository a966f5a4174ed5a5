#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/machine_file.hpp"
#include "core/setting.hpp"

namespace twin::config {

/// A value as a machine file or a --set writes it.
using Value = SettingValue;

/// A field that holds one of a few named values, an enumeration.
struct Choice {
  std::vector<std::string_view> names;  ///< in the order of the enumeration
  std::function<std::size_t()> get;     ///< the field's place in `names`
  std::function<void(std::size_t)> set;
};

/// The choice of an enumeration whose values count from 0 in the order of `names`.
template <class Enum>
Choice choice(Enum& field, std::vector<std::string_view> names) {
  return {std::move(names), [&field] { return static_cast<std::size_t>(field); },
          [&field](std::size_t i) { field = static_cast<Enum>(i); }};
}

/// One setting: its key, what it means, which values it may have, and the field that holds it.
///
/// The key wears its unit (`acceleration_mm_per_s2`); the bare name (`acceleration`) means the
/// same. The field is in base units: field = value / per_base.
struct Binding {
  using Target = std::variant<double*, int*, bool*, std::string*, Vec3*, Choice>;

  std::string section;  ///< "limits", "servo.x"
  std::string name;     ///< "acceleration"
  std::string unit;     ///< "mm_per_s2", or empty
  Target target;
  double min;                    ///< smallest value, in the key's unit; of a text its least length
  double max;                    ///< largest value, in the key's unit
  std::string_view doc;          ///< what it means, in a few words
  double per_base = 1.0;         ///< how many of the key's unit are one base unit: 60 for mm/min
  std::string_view former = {};  ///< path that it had before, "interpolator.kind"; still understood

  /// "acceleration_mm_per_s2"
  std::string key() const { return unit.empty() ? name : name + "_" + unit; }
  /// "limits.acceleration_mm_per_s2"
  std::string path() const { return section + "." + key(); }
  /// True for the key with or without its unit.
  bool is_called(std::string_view text) const { return text == name || text == key(); }
};

/// All settings of a machine: the one list from which files, --set and listings work.
///
/// The bindings point into `machine`, which must outlive them and stay where it is.
std::vector<Binding> bindings(MachineFile& machine);

/// The part of bindings() that is about the simulated table.
std::vector<Binding> table_bindings(hal::mujoco::TableParams& table);

/// The part of bindings() that is about monitors, correction, uncertainty, shadow and wall clock.
std::vector<Binding> safety_bindings(MachineFile& machine);

/// The part of bindings() that is about the real rig.
std::vector<Binding> rig_bindings(hal::rig::RigSettings& rig);

/// The setting with a key, by its present name, with or without unit, or by its former one.
/// @returns null where there is none
const Binding* find_binding(const std::vector<Binding>& list, std::string_view section,
                            std::string_view name);

/// "interpolator.kind is now called path.curves", where that is how the setting was asked for;
/// else empty.
std::string renaming_note(const Binding& binding, std::string_view section);

/// Gives the field a value; the error has the key, the value, its unit and the range.
Expected<void> assign(const Binding& binding, const Value& value);

/// The field's value, in the key's unit.
Value setting_value(const Binding& binding);

/// The same as TOML writes it.
std::string value_text(const Binding& binding);

/// "mm/s^2" from "mm_per_s2", "1/s" from "per_s"; empty stays empty.
std::string pretty_unit(std::string_view unit);

/// "0.125 to 4 ms", the names of a choice, "true, false"; empty where any text will do
std::string range_text(const Binding& binding);

}  // namespace twin::config
