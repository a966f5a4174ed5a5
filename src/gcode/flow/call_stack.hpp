#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gcode/text/line_source.hpp"

namespace twin::gcode {

/// How a stretch of program was begun, and so how it ends.
enum class CallKind : std::uint8_t {
  kMain,      ///< the program itself
  kOWord,     ///< o100 call: ends with endsub or return, has variables of its own
  kNumbered,  ///< M98 P100: ends with M99, shares all variables
  kMacro,     ///< G65 P100: ends with M99, has variables of its own, which are its arguments
};

/// One program or subprogram that runs.
struct Frame {
  /// How often the body of a repeat is still to run.
  struct Loop {
    std::size_t entry = 0;
    std::int64_t left = 0;
  };

  CallKind kind = CallKind::kMain;
  std::size_t unit = 0;           ///< the text it runs in
  std::string label;              ///< of the subroutine
  LineSource::Place body;         ///< where it begins
  LineSource::Place back;         ///< where the caller goes on, in the caller's text
  std::int64_t calling_line = 0;  ///< of the caller, in its text
  std::int64_t left = 1;          ///< runs of M98 L that are left, this one included
  std::vector<double> arguments;  ///< of a macro: its #1 to #33
  std::uint64_t serial = 0;       ///< no two calls of a reading have the same
  bool has_words = false;         ///< a line was executed since its begin
  std::vector<Loop> loops;        ///< repeats that run

  std::int64_t& loop(std::size_t entry) {
    for (Loop& known : loops) {
      if (known.entry == entry) {
        return known.left;
      }
    }
    return loops.emplace_back(Loop{entry, 0}).left;
  }
};

}  // namespace twin::gcode
