#include "feedrate/limits/feedrate_rule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "feedrate/limits/chord_limit.hpp"
#include "feedrate/limits/contact_limit.hpp"

namespace twin::feedrate {
namespace {

FeedrateRule chosen(FeedrateRule rule, FeedrateRule automatic) {
  return rule == FeedrateRule::kAuto ? automatic : rule;
}

}  // namespace

FeedrateRules::FeedrateRules(Limits limits, const PlanningModel& model, const PathSettings& path,
                             double period)
    : limits_(std::move(limits)),
      model_(model),
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
      return curvature_feedrate(at.curvature, feedrate, model_, limits_);
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
