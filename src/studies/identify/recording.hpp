#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "hal/machine.hpp"
#include "studies/identify/recording_columns.hpp"

namespace twin::studies::identify {

/// One axis of a recording, in base units; empty where the file does not have it.
struct AxisSignals {
  std::vector<double> command;   ///< set points [mm]
  std::vector<double> measured;  ///< [mm]
  std::vector<double> volts;     ///< drive command, in the unit of its quantity; may be empty
  Quantity volts_in = Quantity::kVoltage;  ///< or a speed
  std::vector<double> force;               ///< of the motor, [N] or [N m]; may be empty
  Quantity force_in = Quantity::kForce;    ///< or a torque
  std::vector<double> scale{};             ///< position of the table by a scale [mm]; may be empty

  bool is_recorded() const noexcept { return !command.empty(); }
};

/// A trace from any machine. It has evenly spaced times, commanded and measured positions, and
/// perhaps drive commands.
struct Recording {
  std::filesystem::path file;
  double period = 0.0;  ///< time between rows [s]
  std::size_t rows = 0;
  std::array<AxisSignals, hal::kServoAxes> axis;
  std::size_t first_row = 0;                      ///< of a file that was cut where its time jumps
  std::array<bool, hal::kServoAxes> has_moved{};  ///< enough to be fitted
  bool is_at_table = false;                       ///< measured by an encoder at the table
  std::vector<std::string> notes;                 ///< what looked odd and was accepted
};

/// Reads a file and checks whether it can be what it claims to be.
///
/// Where time jumps by more than 50 rows, or back, a new recording begins.
///
/// An error names the column. Refused are a missing column, a value that is no finite number, time
/// that does not go on evenly, too few rows, a unit that is wrong by a factor of about 1000, and a
/// measured position that does not follow the command.
/// @param limits  of the machine, for what is plausible
Expected<std::vector<Recording>> read_recordings(const std::filesystem::path& file,
                                                 const ColumnMap& columns, const Limits& limits);

/// The same for a file of one recording; a jump of time is an error.
Expected<Recording> read_recording(const std::filesystem::path& file, const ColumnMap& columns,
                                   const Limits& limits);

}  // namespace twin::studies::identify
