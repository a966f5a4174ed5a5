#include "gcode/interpreter.hpp"

#include "gcode/arc_words.hpp"
#include "gcode/line_words.hpp"
#include "gcode/word_rules.hpp"

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
  if (auto checked = check_words(words, state_); !checked) {
    return checked;
  }
  if (words.has(MGroup::kToolChange)) {
    add_rest(0.0, line, blocks);
  }
  if (words.has(GGroup::kDwell)) {
    add_rest(words.value('P'), line, blocks);
  }
  if (asks_for_move(words, state_)) {
    if (auto moved = add_move(words, line, blocks); !moved) {
      return moved;
    }
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
    if (auto shaped = shape_arc(words, block); !shaped) {
      return shaped;
    }
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

}  // namespace twin::gcode
