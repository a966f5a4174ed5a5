#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace twin::config {

/// A setting as a user looks at it.
struct ShownSetting {
  std::string section;  ///< "servo.x"
  std::string key;      ///< with its unit, as in "kp_per_s"
  std::string value;    ///< as TOML writes it
  std::string range;    ///< "0 to 1e+05 1/s", names; empty where any text will do
  std::string meaning;
  std::string origin;  ///< "built in", name of the machine file, "--set"
};

/// All settings of a machine file with some changes, and where each comes from.
Expected<std::vector<ShownSetting>> shown_settings(const std::filesystem::path& file,
                                                   std::span<const std::string> overrides);

}  // namespace twin::config
