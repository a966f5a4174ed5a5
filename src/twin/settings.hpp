#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "twin/export.hpp"

namespace twin {

/// All settings of a machine and of its controller: the contents of a machine file (TOML).
///
///     twin::Settings settings("xy_table.toml");
///     settings.set("limits.jerk_mm_per_s3", 20000.0);
///
/// A key is "SECTION.NAME". The name ends with its unit, as in "limits.jerk_mm_per_s3"; the short
/// form "limits.jerk" means the same setting. In both forms the number is in the unit that the full
/// key names, here mm/s^3.
///
/// Copies are independent. Two threads may use two objects at the same time, but not the same one
/// while it changes.
class TWIN_EXPORT Settings {
 public:
  /// Reads a machine file.
  /// @param name  path of the file, or its name if it is in the folder mjcf
  /// @throws Failure if there is no such file, or with line and column of an error in it
  explicit Settings(const std::string& name = "xy_table.toml");
  Settings(const Settings& other);
  Settings& operator=(const Settings& other);
  Settings(Settings&&) noexcept;
  Settings& operator=(Settings&&) noexcept;
  ~Settings();

  /// Changes one setting.
  /// @param assignment  "KEY=VALUE" as in the option --set, "limits.jerk_mm_per_s3=20000"
  /// @returns these settings, so that calls can be chained
  /// @throws Failure if the key is unknown or the value is out of range; nothing has changed then
  Settings& set(const std::string& assignment);
  /// Changes one number.
  /// @param value  in the unit that the full key names
  /// @throws Failure as above
  Settings& set(const std::string& key, double value);

  /// Value of a numeric setting, in the unit that the full key names.
  /// @throws Failure if the key is unknown or its setting is not a number
  double number(std::string_view key) const;
  /// Value of any setting, written as in the machine file, but a text without its quotes.
  /// @throws Failure if the key is unknown
  std::string text(std::string_view key) const;
  /// All full keys, in the order of the machine file.
  std::vector<std::string> keys() const;

  /// Name of the machine file without folder and ending, "xy_table".
  std::string name() const;
  /// All settings as the text of a machine file, each with its meaning and its range.
  std::string toml() const;
  /// Settings that were changed because they do not fit the others, one sentence for each.
  std::vector<std::string> notes() const;

 private:
  friend struct Inside;
  struct Data;
  explicit Settings(std::unique_ptr<Data> data);

  std::unique_ptr<Data> data_;
};

}  // namespace twin
