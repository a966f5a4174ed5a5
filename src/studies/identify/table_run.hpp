#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/block.hpp"
#include "gcode/program_text.hpp"
#include "motion/interpolator/set_point.hpp"
#include "motion/servo/axis_servo.hpp"

namespace twin::studies::identify {

/// The errors of a run as Tables 4 and 5 of the paper list them.
struct RunErrors {
  double contour_max = 0.0;          ///< encoder against programmed path [mm]
  double contour_rms = 0.0;          ///< [mm]
  std::array<double, 2> axis_max{};  ///< tracking error, x and y [mm]
  std::array<double, 2> axis_rms{};  ///< [mm]
};

/// A program with its set points, ready to be run again and again on changed tables.
///
/// Set points do not depend on the table, and each axis is one AxisModel; so a run costs the
/// simulation of two axes and the distances from the programmed path, nothing else.
class TableRun {
 public:
  /// Plans a program. @param feedrate  replaces the F words [mm/s]
  static Expected<TableRun> plan(const gcode::ProgramText& program,
                                 const config::MachineFile& machine,
                                 std::optional<double> feedrate = std::nullopt);

  /// From the first set point to the last [s].
  double machining_time() const noexcept { return machining_time_; }

  /// Runs the program on the table and with the servo gains of a machine file, whose planning keys
  /// do not count. A run that becomes unstable has infinite errors.
  RunErrors run(const config::MachineFile& machine) const;

 private:
  std::vector<gcode::Block> blocks_;
  std::vector<std::int64_t> on_block_;  // of each set point
  std::vector<Vec3> positions_;         // of the set points [mm]
  std::array<std::vector<motion::Reference>, 2> references_;
  double machining_time_ = 0.0;
};

/// The set points of a program, one per interpolation period, as a run has them.
///
/// They do not depend on the table, so one plan serves any number of simulations.
/// @param feedrate  replaces the F words [mm/s]
Expected<std::vector<motion::SetPoint>> plan_set_points(
    const gcode::ProgramText& program, const config::MachineFile& machine,
    std::optional<double> feedrate = std::nullopt);

}  // namespace twin::studies::identify
