#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/vec.hpp"

namespace twin {

/// Whose language an NC program is written in, where controls differ.
enum class Dialect : std::uint8_t {
  kAuto,      ///< as the program's text shows
  kLinuxCnc,  ///< RS274/NGC as LinuxCNC reads it; also what is said of no dialect
  kFanuc,     ///< FANUC with custom macro B
  kGrbl,
};

/// Names of the dialects, in the order of Dialect.
inline constexpr std::array<std::string_view, 4> kDialectNames{"auto", "linuxcnc", "fanuc", "grbl"};

/// How NC programs are read: section [program] of the machine file.
struct ProgramSettings {
  Dialect dialect = Dialect::kAuto;
  std::string ignored_axes;                 ///< letters of "ABCEUVW" whose words are left out
  double default_feedrate = 1000.0 / 60.0;  ///< for feed moves without an F; 0: none [mm/s]
  std::string parameters;         ///< values of parameters at a program's start; empty: none
  Vec3 workpiece = Vec3::Zero();  ///< where the origin of a program's coordinates lies [mm]
  Vec3 start = Vec3::Zero();      ///< where the machine stands when a program begins [mm]
  bool lifts_start = true;        ///< above that, if the program begins with a rapid across
  std::string tool_table;         ///< file with lengths and diameters of tools; empty: none
  bool skips_deleted = true;      ///< lines that begin with '/' are left out
  int most_lines = 20'000'000;  ///< that loops and calls execute again before the program is ended
};

}  // namespace twin
