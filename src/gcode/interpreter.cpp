#include "gcode/interpreter.hpp"

#include <fmt/format.h>

#include <utility>

#include "gcode/arc_words.hpp"
#include "gcode/lexer.hpp"
#include "gcode/line_words.hpp"

namespace twin::gcode {

Expected<void> Interpreter::execute(const LineWords& words, std::int64_t line, LineBlocks& blocks) {
  blocks.count = 0;
  blocks.is_end = words.has(MGroup::kStop, MWord::kEnd);
  const MotionMode before = state_.motion;
  update(state_, words, feedrate_);
  if ((nurbs_.is_open() || state_.is_nurbs() || words.has(GGroup::kMotion)) &&
      concerns_nurbs(words)) {
    return execute_nurbs(words, before, line, blocks);
  }
  TWIN_CHECK(check_words(words, state_));
  if (words.has(MGroup::kToolChange)) {
    add_rest(0.0, line, blocks);
  }
  if (words.has(GGroup::kDwell)) {
    add_rest(words.value('P'), line, blocks);
  }
  if (asks_for_move(words, state_)) {
    TWIN_CHECK(add_move(words, line, blocks));
  }
  if (words.has(MGroup::kStop, MWord::kStop)) {
    add_rest(0.0, line, blocks);
  }
  return {};
}

Expected<void> Interpreter::add_move(const LineWords& words, std::int64_t line,
                                     LineBlocks& blocks) {
  Block& block = blocks.block[blocks.count];
  block.path_mode = state_.path_mode;
  block.start = position_;
  block.end = programmed_ = target(words);
  block.tolerance = state_.tolerance;
  block.dwell = 0.0;
  block.line = line;
  if (state_.is_arc()) {
    block.motion = Motion::kArc;
    block.feedrate = state_.feedrate;
    TWIN_CHECK(shape_arc(words, block));
  } else {
    const bool is_rapid = state_.motion == MotionMode::kRapid;
    block.motion = is_rapid ? Motion::kRapid : Motion::kLinear;
    block.feedrate = is_rapid ? 0.0 : state_.feedrate;
    if ((block.end - block.start).squaredNorm() < kNoLength * kNoLength) {
      return {};
    }
  }
  ++blocks.count;
  position_ = block.end;
  return {};
}

Expected<void> Interpreter::shape_arc(const LineWords& words, Block& block) const {
  const ArcEnds ends{block.start, block.end, state_.plane,
                     state_.motion == MotionMode::kArcClockwise};
  const Vec3 offset(words.value_or_zero('I'), words.value_or_zero('J'), words.value_or_zero('K'));
  auto arc = words.has('R') ? arc_by_radius(ends, words.value('R') * state_.unit)
                            : arc_by_offset(ends, offset * state_.unit);
  if (!arc) {
    arc.error().column = words.first_column("IJKR");
    return tl::unexpected<Error>(std::move(arc.error()));
  }
  block.arc = arc->geometry;
  block.end = arc->end;
  return {};
}

void Interpreter::add_rest(double duration, std::int64_t line, LineBlocks& blocks) const {
  Block& block = blocks.block[blocks.count++];
  block.motion = Motion::kDwell;
  block.path_mode = state_.path_mode;
  block.start = block.end = position_;
  block.feedrate = 0.0;
  block.tolerance = state_.tolerance;
  block.dwell = duration;
  block.line = line;
}

Vec3 Interpreter::target(const LineWords& words) const noexcept {
  Vec3 place = programmed_;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char letter = "XYZ"[axis];
    if (words.has(letter)) {
      const double number = words.value(letter) * state_.unit;
      place[axis] = state_.is_incremental ? programmed_[axis] + number : number;
    }
  }
  return place;
}

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
    TWIN_CHECK(nurbs_.add(words, state_));
  } else if (!has_motion) {
    return fail_at(words.first_column("XYZKR"),
                   fmt::format("the NURBS of line {} is complete: expected a G word of motion",
                               nurbs_.line()));
  } else {
    TWIN_CHECK(nurbs_.open(words, state_, position_, line));
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
  TWIN_TRY(auto curve, nurbs_.close(column));
  Block& block = blocks.block[blocks.count++];
  block.motion = Motion::kNurbs;
  block.path_mode = state_.path_mode;
  block.start = position_;
  block.end = position_ = programmed_ = curve->curve.control_points().back();
  block.nurbs = std::move(curve);
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
