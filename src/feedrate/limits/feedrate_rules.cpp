#include "feedrate/limits/feedrate_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace twin::feedrate {
namespace {

constexpr double kVertical = 1e-6;  // level share below which there is no heading

FeedrateRule chosen(FeedrateRule rule, FeedrateRule automatic) {
  return rule == FeedrateRule::kAuto ? automatic : rule;
}

}  // namespace

LocalGeometry local_geometry(const path::PathPoint& at) noexcept {
  const Vec3& t = at.tangent;
  const Vec3& c = at.curvature;
  const double level = std::hypot(t.x(), t.y());
  const double cross = t.x() * c.y() - t.y() * c.x();
  return {c.norm(), level, level > kVertical ? cross / (level * level) : 0.0};
}

double critical_curvature(double acceleration, double feedrate) noexcept {
  return acceleration / (feedrate * feedrate);
}

double servo_model_feedrate(double curvature, const PlanningModel& model) noexcept {
  const double shrink = std::max(1.0 - curvature * model.circular_error, 0.0);
  const double below = shrink * shrink - model.kf * model.kf;
  if (!(curvature > 0.0) || below <= 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  const double omega = model.kp * std::sqrt((1.0 - shrink * shrink) / below);
  return omega / curvature;
}

double curvature_feedrate(double curvature, double feedrate, const PlanningModel& model,
                          const Limits& limits) noexcept {
  if (curvature < critical_curvature(limits.acceleration, feedrate)) {
    return feedrate;
  }
  return std::min({feedrate, servo_model_feedrate(curvature, model),
                   std::sqrt(limits.acceleration / curvature)});
}

double monotone_curvature_feedrate(double curvature, double feedrate, const PlanningModel& model,
                                   const Limits& limits) noexcept {
  if (!(curvature > 0.0)) {
    return feedrate;
  }
  const double limit = std::min(feedrate, std::sqrt(limits.acceleration / curvature));
  return curvature < critical_curvature(limits.acceleration, model.critical_feedrate)
             ? limit
             : std::min(limit, servo_model_feedrate(curvature, model));
}

double chord_error_feedrate(double curvature, double chord_error, double period) noexcept {
  if (!(curvature > 0.0) || curvature * chord_error >= 1.0) {
    return std::numeric_limits<double>::infinity();
  }
  return 2.0 / period * std::sqrt(chord_error * (2.0 / curvature - chord_error));
}

double contact_speed_feedrate(const LocalGeometry& at, double feedrate, double radius,
                              ToolSide side) noexcept {
  const double advance = at.level + (side == ToolSide::kLeft ? radius : -radius) * at.turning;
  if (advance == at.level || advance <= 0.0) {
    return feedrate;
  }
  const double climb = std::max(1.0 - at.level * at.level, 0.0);
  return feedrate / std::sqrt(advance * advance + climb);
}

FeedrateRules::FeedrateRules(Limits limits, const PlanningModel& model, const PathSettings& path,
                             double period)
    : limits_(std::move(limits)),
      model_(model),
      planner_(path.planner),
      on_curves_(chosen(model.feedrate_rule, path.curves == CurveKind::kBezier
                                                 ? FeedrateRule::kConstant
                                                 : FeedrateRule::kServoModel)),
      elsewhere_(chosen(model.feedrate_rule, FeedrateRule::kServoModel)),
      chord_error_(path.chord_error),
      period_(period) {}

double FeedrateRules::limit_by(FeedrateRule rule, const LocalGeometry& at,
                               double feedrate) const noexcept {
  double limit = feedrate;
  switch (rule) {
    case FeedrateRule::kAuto:
    case FeedrateRule::kServoModel:
      return servo_limit(at.curvature, feedrate);
    case FeedrateRule::kConstant:
      return feedrate;
    case FeedrateRule::kChordError:
      limit = std::min(feedrate, chord_error_feedrate(at.curvature, chord_error_, period_));
      break;
    case FeedrateRule::kContactSpeed:
      limit = contact_speed_feedrate(at, feedrate, model_.tool_radius, model_.tool_side);
      limit = std::min(limit, std::max(limits_.feedrate, feedrate));
      break;
  }
  return at.curvature > 0.0 ? std::min(limit, std::sqrt(limits_.acceleration / at.curvature))
                            : limit;
}

}  // namespace twin::feedrate
