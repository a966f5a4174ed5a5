#include "gcode/interpreter/drilling_cycle.hpp"

#include <algorithm>
#include <cmath>

namespace twin::gcode {

DrillingCycle::DrillingCycle(const CycleLine& line, const Vec3& place)
    : line_(line),
      up_(axes_of(line.plane).third),
      place_(place),
      hole_(line.first),
      left_(line.repeats) {
  stage_ = place_[up_] < line_.retract ? Stage::kToRetract : Stage::kToHole;
}

double DrillingCycle::clear() const noexcept {
  return line_.returns_to_retract ? line_.retract : std::max(line_.initial, line_.retract);
}

CycleMove DrillingCycle::to(CycleMove::Kind kind, double height, Stage then) {
  place_[up_] = height;
  stage_ = then;
  return {kind, place_, 0.0};
}

DrillingCycle::Stage DrillingCycle::at_bottom() const noexcept {
  switch (line_.kind) {
    case CycleKind::kDwell:
    case CycleKind::kBore:
    case CycleKind::kTap:
    case CycleKind::kDwellFeed:
      return Stage::kRest;
    case CycleKind::kFeedOut:
      return Stage::kFeedOut;
    default:
      return Stage::kOut;
  }
}

CycleMove DrillingCycle::peck(Stage then_if_not_done) {
  depth_ = std::max(depth_ - line_.peck, line_.bottom);
  return to(CycleMove::Kind::kFeed, depth_, depth_ > line_.bottom ? then_if_not_done : at_bottom());
}

CycleMove DrillingCycle::leave(CycleMove::Kind kind) {
  --left_;
  if (line_.polar_step) {
    const double radius = std::hypot(hole_.x(), hole_.y()) + line_.polar_step->x();
    const double angle = std::atan2(hole_.y(), hole_.x()) + line_.polar_step->y();
    hole_.head<2>() = radius * Vec2(std::cos(angle), std::sin(angle));
  } else {
    hole_ += line_.step;
  }
  return to(kind, clear(), left_ > 0 ? Stage::kToHole : Stage::kDone);
}

std::optional<CycleMove> DrillingCycle::next() {
  switch (stage_) {
    case Stage::kToRetract:
      return to(CycleMove::Kind::kRapid, line_.retract, Stage::kToHole);
    case Stage::kToHole: {
      const double height = std::max(place_[up_], clear());
      place_ = hole_;
      return to(CycleMove::Kind::kRapid, height, Stage::kDown);
    }
    case Stage::kDown:
      depth_ = line_.retract;
      return to(CycleMove::Kind::kRapid, line_.retract, Stage::kFeed);
    case Stage::kFeed:
      if (line_.kind == CycleKind::kPeck || line_.kind == CycleKind::kChipBreak) {
        return peck(Stage::kBack);
      }
      return to(CycleMove::Kind::kFeed, line_.bottom, at_bottom());
    case Stage::kBack:
      if (line_.kind == CycleKind::kPeck) {
        return to(CycleMove::Kind::kRapid, line_.retract, Stage::kAgain);
      }
      return to(CycleMove::Kind::kRapid, depth_ + kClearance, Stage::kFeed);
    case Stage::kAgain:
      return to(CycleMove::Kind::kRapid, depth_ + kClearance, Stage::kFeed);
    case Stage::kRest:
      stage_ = line_.kind == CycleKind::kDwell || line_.kind == CycleKind::kBore ? Stage::kOut
                                                                                 : Stage::kFeedOut;
      return CycleMove{CycleMove::Kind::kRest, place_, line_.dwell};
    case Stage::kFeedOut:
      return line_.kind == CycleKind::kFeedOut
                 ? to(CycleMove::Kind::kFeed, line_.retract, Stage::kOut)
                 : leave(CycleMove::Kind::kFeed);
    case Stage::kOut:
      return leave(CycleMove::Kind::kRapid);
    default:
      return std::nullopt;
  }
}

}  // namespace twin::gcode
