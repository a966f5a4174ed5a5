#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "twin/export.hpp"

namespace twin {

class Settings;

/// What is known of a program once it has been read.
struct ProgramFigures {
  std::int64_t blocks = 0;          ///< blocks that move
  double length = 0.0;              ///< of the programmed path [mm]
  std::array<double, 3> box_min{};  ///< smallest x, y, z that it reaches [mm]
  std::array<double, 3> box_max{};  ///< largest x, y, z that it reaches [mm]
};

/// An NC program: where its text is, and the feedrate it is run at.
///
/// A value that does not change and is cheap to copy. Thread-safe. Its text is read whenever it is
/// checked, planned or run, block by block, so that its length does not matter; what is wrong with
/// it is told then, as a Failure with file, line and column.
class TWIN_EXPORT Program {
 public:
  /// A program in a file. @param name  a path, or the name of a program in nc_programs
  /// @throws Failure if there is no such file
  static Program from_file(const std::string& name);
  /// A program held in memory. @param name  what messages and summaries call it
  static Program from_text(std::string text, std::string name = "program.nc");

  /// The same program at one feedrate in place of its F words, which may then be missing.
  /// @param feedrate  programmed feedrate, > 0 [mm/s]
  Program with_feedrate(double feedrate) const;

  /// File name, without folders.
  std::string name() const;

  /// Reads the whole program and holds it against the machine's travel; nothing is planned.
  /// @throws Failure for the first thing that is wrong
  ProgramFigures check(const Settings& settings) const;

 private:
  friend struct Inside;
  struct Data;
  explicit Program(std::shared_ptr<const Data> data);

  std::shared_ptr<const Data> data_;
};

}  // namespace twin
