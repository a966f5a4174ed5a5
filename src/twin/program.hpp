#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "twin/export.hpp"

namespace twin {

class Settings;

/// Size of a program, known once all of it has been read.
struct ProgramFigures {
  std::int64_t blocks = 0;          ///< number of blocks that move
  double length = 0.0;              ///< length of the programmed path [mm]
  std::array<double, 3> box_min{};  ///< smallest x, y, z that the path reaches [mm]
  std::array<double, 3> box_max{};  ///< largest x, y, z that the path reaches [mm]
};

/// An NC program (G-code): a file or a text in memory, and optionally a feedrate of its own.
///
///     const auto program = twin::Program::from_text("G21 G90\nG1 X10 Y5 F1200\nM30\n");
///
/// The text is not read here. It is read block by block whenever the program is checked, planned or
/// run, so a program may be of any length. An error in the text is reported then, as a Failure with
/// file, line and column.
///
/// A program does not change and is cheap to copy. All functions are thread-safe.
class TWIN_EXPORT Program {
 public:
  /// A program in a file.
  /// @param name  path of the file, or its name if it is in the folder nc_programs
  /// @throws Failure if there is no such file
  static Program from_file(const std::string& name);
  /// A program held in memory.
  /// @param text  the G-code
  /// @param name  name of the program in messages and summaries
  static Program from_text(std::string text, std::string name = "program.nc");

  /// Returns the same program with one feedrate in place of all F words, which may then be missing.
  /// @param feedrate  programmed feedrate, > 0 [mm/s]; an F word is in mm/min
  /// @throws Failure if the feedrate is not above 0
  Program with_feedrate(double feedrate) const;

  /// Name of the file without its folders, "square.nc"; for a text the name given to from_text().
  std::string name() const;

  /// Reads the whole program and checks that it stays within the travel of the machine. Nothing is
  /// planned, and nothing moves.
  /// @param settings  their [limits] have the travel
  /// @param stop      ends the work early when it is set by another thread; may be null
  /// @returns number of blocks, length and bounding box
  /// @throws Failure for the first error in the program, or kInterrupted
  ProgramFigures check(const Settings& settings, const std::atomic<bool>* stop = nullptr) const;

 private:
  friend struct Inside;
  struct Data;
  explicit Program(std::shared_ptr<const Data> data);

  std::shared_ptr<const Data> data_;
};

}  // namespace twin
