#include "gcode/modal_state.hpp"

#include "core/units.hpp"
#include "gcode/line_words.hpp"

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

}  // namespace

void update(ModalState& state, const LineWords& words, const std::optional<double>& feedrate) {
  if (words.has(GGroup::kUnits)) {
    state.unit = words.g(GGroup::kUnits) == GWord::kInch ? units::kMmPerInch : 1.0;
  }
  if (words.has('F')) {
    state.feedrate = units::mm_per_s_from_mm_per_min(words.value('F') * state.unit);
  }
  if (feedrate) {
    state.feedrate = *feedrate;
  }
  if (words.has(GGroup::kMotion)) {
    state.motion = motion_of(words.g(GGroup::kMotion));
  }
  if (words.has(GGroup::kPlane)) {
    state.plane = plane_of(words.g(GGroup::kPlane));
  }
  if (words.has(GGroup::kDistance)) {
    state.is_incremental = words.g(GGroup::kDistance) == GWord::kIncremental;
  }
  if (words.has(GGroup::kPathMode)) {
    update_path_mode(state, words);
  }
}

}  // namespace twin::gcode
