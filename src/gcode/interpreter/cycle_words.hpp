#pragma once

#include <optional>

#include "core/error.hpp"
#include "gcode/interpreter/drilling_cycle.hpp"
#include "gcode/words/codes.hpp"

namespace twin::gcode {

class LineWords;
struct ModalState;

/// What the words of a line with a canned cycle mean, and the numbers that stay from line to line.
///
/// Z, R, Q and P keep their value while the same cycle goes on; L, the repeats (K with FANUC), does
/// not. With G90 all places are absolute. With G91 X and Y go on from the hole before, R counts from
/// the height at which the series began, and Z from R. The series, and with it that height, goes on
/// until G80 or another G word of motion. Numbers are kept in the program's units.
class CycleWords {
 public:
  static constexpr std::int64_t kMostPecks = 10000;    ///< of one hole
  static constexpr std::int64_t kMostRepeats = 10000;  ///< of one line

  /// Ends the series.
  void cancel() { initial_.reset(); }

  /// Reads a line.
  ///
  /// @param place  where the tool is, in the coordinates of the program [mm]
  /// @param hole   where the line's X and Y lead; its third axis is not used [mm]
  Expected<CycleLine> read(const LineWords& words, const ModalState& state, const Vec3& place,
                           const Vec3& hole);

 private:
  struct Kept {
    std::optional<double> bottom;
    std::optional<double> retract;
    std::optional<double> peck;
    std::optional<double> dwell;
  };
  Expected<void> keep(const LineWords& words, char up);
  Expected<std::int64_t> repeats(const LineWords& words) const;
  Expected<void> check(const CycleLine& line, int column) const;

  std::optional<double> initial_;  // height at which the series began [mm]
  GWord code_ = GWord::kCancelMotion;
  Kept kept_;
};

}  // namespace twin::gcode
