#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "motion/correction/correction_follower.hpp"

/// Files of offsets that a run adds to its set points.
namespace twin::runtime {

/// The machine that a corrected run is planned for: corners within compensation.path_tolerance, and
/// the share compensation.reserve of acceleration and jerk kept for the offsets.
config::MachineFile planned_with_reserve(const config::MachineFile& machine);

/// What a correction was made for. A run takes no correction that was made for something else.
struct CorrectionOrigin {
  std::string program;         ///< file name, for messages
  std::string program_sha256;  ///< of the program and its subprograms
  std::string machine;         ///< name, for messages
  /// Of the settings that set points and motion depend on: all but rig, safety, wall clock and home,
  /// the phases of encoder and hum, and the folder of the model.
  std::string machine_sha256;
  double period = 0.001;           ///< [s]
  std::optional<double> feedrate;  ///< in place of the F words [mm/s]
};

/// The origin of a correction for a program on a machine.
CorrectionOrigin correction_origin(const gcode::ProgramText& program,
                                   const config::MachineFile& machine,
                                   const std::optional<double>& feedrate);

/// Writes a correction: what it was made for as lines `# key = value`, then a row a period with set
/// point and offsets.
/// @param remark  a line for a reader, as in "contour error 16.9 -> 3.2 um on the model"
Expected<void> write_correction(const std::filesystem::path& file,
                                const motion::Correction& correction,
                                const CorrectionOrigin& origin, const std::string& remark);

/// Reads a correction back.
///
/// @param wanted  what it must have been made for
/// @param limit   largest offset [mm]
/// @returns an error with file and line where the text is no correction, was made for another
///          program, machine, period or feedrate, or has an offset beyond the limit
Expected<motion::Correction> read_correction(const std::filesystem::path& file,
                                             const CorrectionOrigin& wanted, double limit);

/// What became of a correction, for the notes of a run.
std::string correction_note(const motion::CorrectionFollower& follower, double period);

}  // namespace twin::runtime
