#include <fmt/format.h>

#include "gcode/interpreter/interpreter.hpp"
#include "gcode/interpreter/thread_words.hpp"
#include "gcode/notes.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

// Moves that a probe would end, G38.2 to G38.5 and G31, and moves that the turning spindle would
// lead, G33, G33.1 and G76: they go their whole way at their feedrate.

namespace twin::gcode {

Expected<void> Interpreter::check_probing(const LineWords& words) {
  const int column =
      words.has(GGroup::kMotion) ? words.column(GGroup::kMotion) : words.first_column("XYZ");
  if (!may_probe_) {
    return fail_at(column,
                   "a probing move (G31, G38) would not stop on this machine: there is no probe; "
                   "expected a simulated machine");
  }
  if (compensation_.is_on()) {
    return fail_at(column, "probing with the cutter compensation on: expected G40 before it");
  }
  if (state_.feed_mode == FeedMode::kPerRevolution) {
    return fail_at(column, "probing with G95 (feed per revolution) in force: expected G94");
  }
  notes_->add(NoteKind::kProbing, "there is no probe: the move goes its whole way", line_);
  return {};
}

/// The end of a probing move, which nothing has touched.
void Interpreter::keep_probed() {
  probed_ = Probed{Vec3(programmed_ / state_.unit), state_.motion == MotionMode::kSkip};
}

Expected<void> Interpreter::add_threading(const LineWords& words, LineBlocks& blocks) {
  if (compensation_.is_on()) {
    return fail_at(words.first_column("XYZ"),
                   "thread cutting with the cutter compensation on: expected G40 before it");
  }
  if (state_.is_fanuc && state_.motion == MotionMode::kThreadCycle) {
    return fail_at(words.has(GGroup::kMotion) ? words.column(GGroup::kMotion) : 1,
                   "G76 (fine boring) of FANUC is not supported: expected its moves written out as "
                   "G00 to G03");
  }
  TWIN_TRY(const double feedrate, thread_feedrate(words, state_, feedrate_));
  TWIN_TRY(const Vec3 end, target(words));
  must_leave_straight_ = false;
  if (state_.motion == MotionMode::kThreadCycle) {
    TWIN_TRY(const ThreadLine line, read_thread_line(words, state_, programmed_, end, feedrate));
    threading_ = ThreadingCycle(line);
  } else if (state_.motion == MotionMode::kRigidTap) {
    TWIN_TRY(const double factor, return_factor(words));
    const Vec3 start = position_;
    add_straight(Motion::kLinear, coordinates().machine_of(end), feedrate, blocks);
    add_straight(Motion::kLinear, start, factor * feedrate, blocks);
  } else {
    programmed_ = end;
    add_straight(Motion::kLinear, coordinates().machine_of(end), feedrate, blocks);
  }
  notes_->add(NoteKind::kWithoutEffect,
              "G33, G33.1 and G76 move at their lead times S; the spindle is not coupled to them",
              line_);
  return {};
}

}  // namespace twin::gcode
