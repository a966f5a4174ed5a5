#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "gcode/notes.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::runtime {

/// What reading a whole program says before anything moves.
struct ProgramFigures {
  std::int64_t blocks = 0;         ///< blocks that move
  std::int64_t lines = 0;          ///< lines of text
  double length = 0.0;             ///< programmed length [mm]
  Vec3 end = Vec3::Zero();         ///< end of the last block, or the start [mm]
  Vec3 box_min = Vec3::Zero();     ///< lower corner of the space it moves in, start included [mm]
  Vec3 box_max = Vec3::Zero();     ///< upper corner [mm]
  std::vector<gcode::Note> notes;  ///< on the program
};

/// Holds the blocks of a program against the machine's travel, one after the other.
class TravelCheck {
 public:
  /// @param file   for messages
  /// @param start  position before the first block [mm]
  TravelCheck(std::string file, const Vec3& start, const Limits& limits);

  /// @returns an error if the block leaves the travel: axis, place, limit, line. The same end of an
  /// axis is told once.
  Expected<void> add(const gcode::Block& block);
  /// Of the blocks so far; the lines of text are left to the caller.
  const ProgramFigures& figures() const noexcept { return figures_; }

 private:
  std::string file_;
  Limits limits_;
  ProgramFigures figures_;
  std::array<std::array<bool, 2>, 3> is_told_{};  // ends of the axes
};

/// Reads a program to its end and holds it against the machine's travel.
///
/// @param stop  ends it with kInterrupted; may be null
/// @returns the first error of the program, or the first block that leaves the travel
Expected<ProgramFigures> check_program(const gcode::ProgramText& program,
                                       const gcode::ReaderOptions& options, const Limits& limits,
                                       const std::atomic<bool>* stop = nullptr);

/// What is known of a program before it runs.
struct Estimate {
  ProgramFigures program;
  PlanFigures plan;      ///< its time is the cycle time of a run, less than a period aside
  bool is_whole = true;  ///< the plan is one of the whole program
};

/// Checks a program like check_program() and plans it in the same reading. Nothing moves.
///
/// @param stop    ends it with kInterrupted; may be null
/// @param listen  if given, gets each planned segment; where it returns false the rest of the
///                program is checked only
Expected<Estimate> estimate_program(
    const gcode::ProgramText& program, const gcode::ReaderOptions& options,
    const config::MachineFile& machine, const std::atomic<bool>* stop,
    const std::function<bool(feedrate::PlannedSegment&&)>& listen = {});

}  // namespace twin::runtime
