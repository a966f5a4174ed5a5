#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "gcode/modal_state.hpp"
#include "gcode/nurbs_collector.hpp"

namespace twin::gcode {

class LineWords;

/// The blocks of one line: at most tool change, dwell, move and stop, in this order. Whoever takes
/// a block moves it out, so that `nurbs` is null in all of them before the next line.
struct LineBlocks {
  std::array<Block, 4> block;
  std::size_t count = 0;
  bool is_end = false;  ///< M02 or M30: nothing after this line is part of the program
};

/// Turns the words of line after line into blocks; holds the modal state and the position.
///
/// Within a line the order of words does not matter; what it asks for is done in the order of
/// RS274: modal words, M06, G04, the move, M00 M01 M02 M30.
class Interpreter {
 public:
  /// @param start     position before the first line [mm]
  /// @param feedrate  feedrate in place of the F words, if any [mm/s]
  Interpreter(const Vec3& start, const std::optional<double>& feedrate)
      : position_(start), programmed_(start), feedrate_(feedrate) {}

  /// Executes a line.
  ///
  /// @param words   words of the line
  /// @param line    its number, from 1
  /// @param blocks  filled with its blocks
  Expected<void> execute(const LineWords& words, std::int64_t line, LineBlocks& blocks);

  /// Ends the program. @returns an error if a NURBS is still open
  Expected<void> finish() const;

 private:
  Expected<void> add_move(const LineWords& words, std::int64_t line, LineBlocks& blocks);
  bool concerns_nurbs(const LineWords& words) const noexcept;
  Expected<void> execute_nurbs(const LineWords& words, MotionMode before, std::int64_t line,
                               LineBlocks& blocks);
  Expected<void> end_nurbs(const LineWords& words, MotionMode before, LineBlocks& blocks);
  Expected<void> add_nurbs(int column, LineBlocks& blocks);
  Expected<void> shape_arc(const LineWords& words, Block& block) const;
  void add_rest(double duration, std::int64_t line, LineBlocks& blocks) const;
  Vec3 target(const LineWords& words) const noexcept;

  ModalState state_;
  Vec3 position_;    // end of the last block [mm]
  Vec3 programmed_;  // where the words have led; off position_ by less than kNoLength [mm]
  std::optional<double> feedrate_;
  NurbsCollector nurbs_;
};

}  // namespace twin::gcode
