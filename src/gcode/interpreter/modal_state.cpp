#include "gcode/interpreter/modal_state.hpp"

#include <cstdint>

#include "core/units.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

MotionMode motion_of(GWord word) {
  switch (word) {
    case GWord::kRapid:
      return MotionMode::kRapid;
    case GWord::kLinear:
      return MotionMode::kLinear;
    case GWord::kArcClockwise:
      return MotionMode::kArcClockwise;
    case GWord::kArcCounterClockwise:
      return MotionMode::kArcCounterClockwise;
    case GWord::kNurbs:
      return MotionMode::kNurbs;
    case GWord::kKnotNurbs:
      return MotionMode::kKnotNurbs;
    case GWord::kProbe:
      return MotionMode::kProbe;
    case GWord::kSkip:
      return MotionMode::kSkip;
    case GWord::kThread:
      return MotionMode::kThread;
    case GWord::kRigidTap:
      return MotionMode::kRigidTap;
    case GWord::kThreadCycle:
      return MotionMode::kThreadCycle;
    case GWord::kChipBreak:
    case GWord::kTapLeft:
    case GWord::kDrill:
    case GWord::kDrillDwell:
    case GWord::kPeckDrill:
    case GWord::kTapRight:
    case GWord::kBoreFeedOut:
    case GWord::kBoreRapidOut:
    case GWord::kBoreDwell:
      return MotionMode::kCycle;
    default:
      return MotionMode::kNone;
  }
}

Plane plane_of(GWord word) {
  switch (word) {
    case GWord::kPlaneZx:
      return Plane::kZx;
    case GWord::kPlaneYz:
      return Plane::kYz;
    default:
      return Plane::kXy;
  }
}

void update_path_mode(ModalState& state, const LineWords& words) {
  const bool is_continuous = words.g(GGroup::kPathMode) == GWord::kContinuous;
  state.path_mode = is_continuous ? PathMode::kContinuous : PathMode::kExactStop;
  state.tolerance = is_continuous ? words.value_or_zero('P') * state.unit : 0.0;
}

FeedMode feed_mode_of(GWord word) {
  switch (word) {
    case GWord::kInverseTime:
      return FeedMode::kInverseTime;
    case GWord::kFeedPerRevolution:
      return FeedMode::kPerRevolution;
    default:
      return FeedMode::kPerMinute;
  }
}

/// Behind a change of the mode the F before it means nothing.
void update_feed(ModalState& state, const LineWords& words) {
  if (words.has(GGroup::kFeedMode)) {
    const FeedMode mode = feed_mode_of(words.g(GGroup::kFeedMode));
    state.feed_number = mode == state.feed_mode ? state.feed_number : 0.0;
    state.feed_mode = mode;
  }
  if (words.has('S')) {
    state.spindle_rpm = words.value('S');
  }
  if (words.has('F')) {
    const double unit = state.feed_mode == FeedMode::kInverseTime ? 1.0 : state.unit;
    state.feed_number = words.value('F') * unit;
    state.has_feed_word = true;
  }
  const double per_minute = state.feed_mode == FeedMode::kPerRevolution
                                ? state.feed_number * state.spindle_rpm
                                : state.feed_number;
  const bool has_none = state.feed_mode == FeedMode::kPerMinute && per_minute == 0.0;
  state.feedrate = has_none ? state.default_feedrate : units::mm_per_s_from_mm_per_min(per_minute);
}

constexpr std::uint32_t kSeldom =
    LineWords::groups_of(GGroup::kPlane, GGroup::kDistance, GGroup::kPathMode, GGroup::kArcDistance,
                         GGroup::kPolar, GGroup::kReturnLevel, GGroup::kSpindleMode);

void update_seldom(ModalState& state, const LineWords& words) {
  if (words.has(GGroup::kPlane)) {
    state.plane = plane_of(words.g(GGroup::kPlane));
  }
  if (words.has(GGroup::kDistance)) {
    state.is_incremental = words.g(GGroup::kDistance) == GWord::kIncremental;
  }
  if (words.has(GGroup::kArcDistance)) {
    state.has_absolute_centres = words.g(GGroup::kArcDistance) == GWord::kAbsoluteCentres;
    state.may_guess_centres = false;
  }
  if (words.has(GGroup::kPolar)) {
    state.is_polar = words.g(GGroup::kPolar) == GWord::kPolar;
  }
  if (words.has(GGroup::kReturnLevel)) {
    state.returns_to_retract = words.g(GGroup::kReturnLevel) == GWord::kReturnToRetract;
  }
  if (words.has(GGroup::kSpindleMode)) {
    state.has_surface_speed = words.g(GGroup::kSpindleMode) == GWord::kSurfaceSpeed;
  }
  if (words.has(GGroup::kPathMode)) {
    update_path_mode(state, words);
  }
}

/// True for the motions of G00 to G03.
bool is_line_or_arc(MotionMode motion) {
  return motion >= MotionMode::kRapid && motion <= MotionMode::kArcCounterClockwise;
}

/// G05 and G05.1 of one line draw a curve; with P or Q alone they are FANUC's wish to look ahead.
void update_motion(ModalState& state, const LineWords& words) {
  const GWord word = words.g(GGroup::kMotion);
  if (word == GWord::kCubicSpline || word == GWord::kQuadraticSpline) {
    if (words.has_any("XYZIJ")) {
      state.motion = MotionMode::kNone;
    }
    return;
  }
  if (state.is_fanuc && is_line_or_arc(state.motion)) {
    state.behind_cycle = state.motion;
  }
  state.motion = word == GWord::kCancelMotion ? state.behind_cycle : motion_of(word);
  state.cycle = word;
}

}  // namespace

/// FANUC's G31 leaves the motion before it in force; of Mach that is not known.
void ModalState::leave_skip(MotionMode before) noexcept {
  if (motion == MotionMode::kSkip) {
    motion = is_fanuc && is_line_or_arc(before) ? before : MotionMode::kNone;
  }
}

void update(ModalState& state, const LineWords& words, const std::optional<double>& feedrate) {
  if (words.has(GGroup::kUnits)) {
    state.unit = words.g(GGroup::kUnits) == GWord::kInch ? units::kMmPerInch : 1.0;
  }
  if (words.has_any("FS") || words.has(GGroup::kFeedMode)) {
    update_feed(state, words);
  }
  if (feedrate) {
    state.feedrate = *feedrate;
  }
  if (words.has(GGroup::kMotion)) {
    update_motion(state, words);
  }
  if ((words.g_groups() & kSeldom) != 0) {
    update_seldom(state, words);
  }
}

}  // namespace twin::gcode
