#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "twin/export.hpp"

namespace twin {

/// All settings of a machine and of the controller that drives it: what is in a machine file.
///
/// A key names a section and a setting, with its unit or without: "servo.x.kp_per_s",
/// "limits.jerk". Numbers are in the unit that the whole key names. A value: copies are
/// independent. Different objects may be used by different threads.
class TWIN_EXPORT Settings {
 public:
  /// Those of a machine file. @param name  a path, or the name of a file in mjcf
  /// @throws Failure with line and column of what is wrong in the file
  explicit Settings(const std::string& name = "xy_table.toml");
  Settings(const Settings& other);
  Settings& operator=(const Settings& other);
  Settings(Settings&&) noexcept;
  Settings& operator=(Settings&&) noexcept;
  ~Settings();

  /// Changes a setting, as --set does: "limits.jerk_mm_per_s3=20000".
  /// @throws Failure, and nothing has changed, if the key is unknown or the value is out of range
  Settings& set(const std::string& assignment);
  /// Changes a number. @param value  in the key's unit
  Settings& set(const std::string& key, double value);

  /// A number, in the key's unit. @throws Failure if the key is unknown or no number
  double number(std::string_view key) const;
  /// A setting as the machine file writes it; a text without its quotes.
  /// @throws Failure if the key is unknown
  std::string text(std::string_view key) const;
  /// All keys, with their units, in the order of the machine file.
  std::vector<std::string> keys() const;

  /// Name of the machine file, without folder and ending.
  std::string name() const;
  /// The whole as the text of a machine file, with what each setting means and its range.
  std::string toml() const;
  /// What was changed because it does not go with the rest, one sentence each.
  std::vector<std::string> notes() const;

 private:
  friend struct Inside;
  struct Data;
  explicit Settings(std::unique_ptr<Data> data);

  std::unique_ptr<Data> data_;
};

}  // namespace twin
