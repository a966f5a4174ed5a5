#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace twin {

/// A value as a machine file or a --set writes it.
using SettingValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// One setting of a machine, in the words of its machine file.
struct Setting {
  std::string section;  ///< "limits", "servo.x"
  std::string key;      ///< with its unit, as in "acceleration_mm_per_s2"
  SettingValue value;   ///< in the key's unit
};

}  // namespace twin
