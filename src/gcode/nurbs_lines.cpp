#include <fmt/format.h>

#include <utility>

#include "gcode/interpreter.hpp"
#include "gcode/lexer.hpp"
#include "gcode/line_words.hpp"

/// The part of Interpreter that hands the lines of a NURBS to NurbsCollector.
namespace twin::gcode {

bool Interpreter::concerns_nurbs(const LineWords& words) const noexcept {
  if (nurbs_.is_open() || (state_.motion == MotionMode::kKnotNurbs && words.has_any("XYZKR"))) {
    return true;
  }
  if (!words.has(GGroup::kMotion)) {
    return false;
  }
  const GWord word = words.g(GGroup::kMotion);
  return word == GWord::kNurbs || word == GWord::kNurbsEnd || word == GWord::kKnotNurbs ||
         word == GWord::kKnotNurbsEnd;
}

Expected<void> Interpreter::execute_nurbs(const LineWords& words, MotionMode before,
                                          std::int64_t line, LineBlocks& blocks) {
  if (words.has_m()) {
    return nurbs_.is_open() ? tl::unexpected<Error>(nurbs_.cut_short("an M word comes"))
                            : fail_at(words.column(GGroup::kMotion),
                                      "an M word beside a NURBS: expected it on a line of its own");
  }
  const bool has_motion = words.has(GGroup::kMotion);
  const GWord word = has_motion ? words.g(GGroup::kMotion) : GWord::kNurbs;
  if (has_motion && (word == GWord::kNurbsEnd || word == GWord::kKnotNurbsEnd)) {
    return end_nurbs(words, before, blocks);
  }
  if (nurbs_.is_open()) {
    if (has_motion && (word != GWord::kNurbs || before != MotionMode::kNurbs)) {
      return tl::unexpected<Error>(nurbs_.cut_short("another G word of motion comes"));
    }
    if (auto added = nurbs_.add(words, state_); !added) {
      return added;
    }
  } else if (!has_motion) {
    return fail_at(words.first_column("XYZKR"),
                   fmt::format("the NURBS of line {} is complete: expected a G word of motion",
                               nurbs_.line()));
  } else if (auto opened = nurbs_.open(words, state_, position_, line); !opened) {
    return opened;
  }
  return nurbs_.is_complete() ? add_nurbs(words.column('K'), blocks) : Expected<void>{};
}

/// G05.3, or G06.3 behind the last knot.
Expected<void> Interpreter::end_nurbs(const LineWords& words, MotionMode before,
                                      LineBlocks& blocks) {
  const int column = words.column(GGroup::kMotion);
  const bool ends_knots = words.g(GGroup::kMotion) == GWord::kKnotNurbsEnd;
  if (before != (ends_knots ? MotionMode::kKnotNurbs : MotionMode::kNurbs)) {
    return fail_at(column, fmt::format("{} without {} before it", ends_knots ? "G06.3" : "G05.3",
                                       ends_knots ? "G06.2" : "G05.2"));
  }
  if (words.has_any("ABCDEFHIJKLOPQRSTUVWXYZ")) {
    return fail_at(words.first_column("ABCDEFHIJKLOPQRSTUVWXYZ"),
                   "a word beside the end of a NURBS: expected it on a line of its own");
  }
  if (ends_knots && nurbs_.is_open()) {
    return tl::unexpected<Error>(nurbs_.cut_short("G06.3 comes"));
  }
  return ends_knots ? Expected<void>{} : add_nurbs(column, blocks);
}

Expected<void> Interpreter::add_nurbs(int column, LineBlocks& blocks) {
  const std::int64_t line = nurbs_.line();
  auto curve = nurbs_.close(column);
  if (!curve) {
    return tl::unexpected<Error>(std::move(curve.error()));
  }
  Block& block = blocks.block[blocks.count++];
  block.motion = Motion::kNurbs;
  block.path_mode = state_.path_mode;
  block.start = position_;
  block.end = position_ = programmed_ = (*curve)->curve.control_points().back();
  block.nurbs = std::move(*curve);
  block.feedrate = state_.feedrate;
  block.tolerance = state_.tolerance;
  block.dwell = 0.0;
  block.line = line;
  return {};
}

Expected<void> Interpreter::finish() const {
  if (nurbs_.is_open()) {
    return tl::unexpected<Error>(nurbs_.cut_short("the program ends"));
  }
  return {};
}

}  // namespace twin::gcode
