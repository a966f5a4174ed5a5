#include "gcode/interpreter/interpreter.hpp"
#include "gcode/interpreter/line_check.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

// States that are kept and put in force again: M70 to M73, and what goes on behind an error.

namespace twin::gcode {
namespace {

constexpr std::uint32_t kAllAxes = 7;  // a bit for each
constexpr double kAnyFeedrate = 1.0;   // of a program that does not run [mm/s]

}  // namespace

Expected<SavedState> Interpreter::saved_state(int column) const {
  if (compensation_.is_on() || nurbs_.is_open()) {
    return fail_at(column,
                   "M70 to M73 with the cutter compensation on, or within a NURBS: expected "
                   "G40 before it");
  }
  return SavedState{state_, coordinates().selected(), coordinates().tool()};
}

void Interpreter::restore(const SavedState& saved) {
  const MotionMode motion = state_.motion;
  const GWord cycle = state_.cycle;
  state_ = saved.state;
  state_.motion = motion;
  state_.cycle = cycle;
  set_up_.restore(saved.work_offset, saved.tool_offset, programmed_);
}

void Interpreter::recover(const LineWords& words, bool is_whole) {
  update(state_, words, feedrate_);
  state_.leave_skip(MotionMode::kLinear);
  cycle_ = DrillingCycle();
  threading_ = ThreadingCycle();
  waiting_.clear();
  next_waiting_ = 0;
  has_pending_stop_ = must_leave_straight_ = false;
  compensation_ = CutterCompensation();
  set_up_.axes_named(kAllAxes);
  is_nurbs_broken_ = is_nurbs_broken_ || nurbs_.is_open() || state_.is_nurbs();
  nurbs_ = NurbsCollector();
  if (state_.motion == MotionMode::kNone && words.has_any("XYZ")) {
    state_.motion = MotionMode::kLinear;
  }
  if (!(state_.feedrate > 0.0)) {
    state_.feedrate = kAnyFeedrate;
    state_.feed_number = state_.default_feedrate > 0.0 ? 0.0 : kAnyFeedrate;
  }
  is_lost_ = is_lost_ || !is_whole;
  if (!is_nurbs_broken_ && asks_for_move(words, state_)) {
    if (const auto place = target(words)) {
      programmed_ = *place;
    }
  }
  position_ = coordinates().machine_of(programmed_);
}

/// Whether a line belongs to a NURBS that has had an error.
bool Interpreter::is_of_broken_nurbs(const LineWords& words) noexcept {
  const bool has_motion = words.has(GGroup::kMotion);
  const GWord word = has_motion ? words.g(GGroup::kMotion) : GWord::kNurbs;
  const bool is_end = word == GWord::kNurbsEnd || word == GWord::kKnotNurbsEnd;
  const bool is_closing = word == GWord::kKnotNurbs && words.has('K') && !words.has_any("XYZP");
  if (!has_motion && !words.has_m() && words.letters() != 0) {
    return true;
  }
  is_nurbs_broken_ = is_closing;
  if (is_end) {
    state_.motion = MotionMode::kNone;
  }
  return is_end || is_closing;
}

}  // namespace twin::gcode
