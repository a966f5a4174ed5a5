#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "studies/identify/axis_model.hpp"
#include "studies/identify/recording.hpp"

namespace twin::studies::identify {

/// The signals of one axis in one trace, one value for each period.
struct AxisRecord {
  std::vector<motion::Reference> command;  ///< set points
  std::vector<double> measured;            ///< positions by the encoder [mm]
  std::vector<double> volts;               ///< drive command [V]; empty where it was not recorded
  std::vector<double> force{};             ///< of the motor at the slide [N]; the same
  std::vector<bool> is_left_out{};         ///< rows that do not count; empty: none
  std::optional<BeginOfMotion> begin{};    ///< where it begins in motion
  std::string trace{};                     ///< name of its file
  std::vector<double> scale{};  ///< position of the table beside `measured` [mm]; the same
  bool is_at_table = false;     ///< `measured` is the table's, not the motor's

  bool has_volts() const noexcept { return !volts.empty(); }
  bool has_force() const noexcept { return !force.empty(); }
  bool has_scale() const noexcept { return !scale.empty(); }
  /// Whether it has the position of the table, be it beside that of the motor.
  bool shows_table() const noexcept { return is_at_table || has_scale(); }
  bool counts(std::size_t row) const { return is_left_out.empty() || !is_left_out[row]; }
};

/// The record of one axis of a recording.
///
/// Volts are computed from a speed command by the machine's V-REF scale, the force from a torque by
/// its lead and, in torque mode, from the drive command where it was not recorded. Rows whose
/// position is between two counts are left out: they were interpolated over late periods.
AxisRecord axis_record(const Recording& recording, hal::Axis axis,
                       const config::MachineFile& machine);

/// Where the measured positions of a record are from.
inline hal::mujoco::EncoderPlace place_of(const AxisRecord& record) {
  return record.is_at_table ? hal::mujoco::EncoderPlace::kTable : hal::mujoco::EncoderPlace::kMotor;
}

/// The rows [first, first + rows) of a record, as a record of its own.
AxisRecord part_of(const AxisRecord& record, std::size_t first, std::size_t rows, double period);

/// Rows of a record that are not held out, where a share of it is.
std::size_t trained_rows(const AxisRecord& record, double held_out_share);

/// Rows at the begin of a record in motion that do not count, because the model settles.
std::size_t settling_rows(const AxisRecord& record, double period);

/// The closed loop of a machine along the set points of a record.
AxisRun follow_record(const config::MachineFile& machine, hal::Axis axis, const AxisRecord& record);

}  // namespace twin::studies::identify
