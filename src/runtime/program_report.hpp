#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/notes.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader_options.hpp"
#include "runtime/program_check.hpp"

namespace twin::runtime {

/// What a tool does in a program.
struct ToolUse {
  int number = 0;               ///< 0: no tool was called
  std::int64_t first_line = 0;  ///< line of its first block
  std::int64_t blocks = 0;      ///< blocks that move with it
  double time = 0.0;            ///< of its blocks, rests included [s]
};

/// Where the machining time of a program goes [s].
struct TimeShares {
  double feed = 0.0;   ///< moves at F
  double rapid = 0.0;  ///< G00
  double rest = 0.0;   ///< dwells
};

/// An error of a program, and how often the same is wrong with it.
struct ProgramError {
  Error error;             ///< at its first place
  std::int64_t count = 1;  ///< lines that have it
};

/// All that a reading of a program tells, whether it can run or not.
struct ProgramReport {
  std::vector<ProgramError> errors;  ///< different ones, in the order of the program; empty: it
                                     ///< can run
  bool has_more_errors = false;      ///< reading ended at the largest number of errors
  std::vector<gcode::Note> notes;    ///< in the order of their kinds, then of the program
  std::int64_t notes_left_out = 0;   ///< further different ones
  ProgramFigures program;            ///< of what could be read
  std::vector<ToolUse> tools;        ///< in the order of their first blocks
  std::set<int> work_offsets;        ///< see gcode::Block::work_offset
  double machining_time = 0.0;       ///< planned; only without errors [s]
  TimeShares shares;                 ///< of the machining time
};

/// Reads a program to its end behind errors too, holds it against the travel, and plans it as far as
/// it has none. Nothing moves.
///
/// @param most_errors  reading ends with this many different ones
/// @param stop         ends it with kInterrupted; may be null
/// @returns an error only if the program cannot be read at all
Expected<ProgramReport> report_program(const gcode::ProgramText& program,
                                       const gcode::ReaderOptions& options,
                                       const config::MachineFile& machine, std::size_t most_errors,
                                       const std::atomic<bool>* stop);

/// "G54", "G59.1" or "G54.1 P7" of gcode::Block::work_offset.
std::string name_of_work_offset(int work_offset);

}  // namespace twin::runtime
