#pragma once

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/limits/curvature_limit.hpp"
#include "feedrate/limits/local_geometry.hpp"

namespace twin::feedrate {

/// The feedrate limit of places of arcs and curves, by the rule of the machine file.
///
///   constant       V_NC and nothing else, not even A_max: what a plain interpolator does
///   chord_error    chord_error_feedrate (chord_limit.hpp)
///   servo_model    curvature_feedrate (curvature_limit.hpp), Eqs. 2 to 6
///   contact_speed  contact_speed_feedrate (contact_limit.hpp); may exceed V_NC
///   auto           servo_model, but constant on the curves of the Bezier interpolator: Fast Bezier
///                  interpolation as published keeps the programmed feedrate through them
/// All but `constant` also keep the normal acceleration, kappa v^2 <= A_max, and none exceeds the
/// machine's largest feedrate.
class FeedrateRules {
 public:
  /// @param period  interpolation period [s]
  FeedrateRules(Limits limits, const PlanningModel& model, const PathSettings& path, double period);

  /// Limit at a place of a fitted curve, or of an arc or line [mm/s].
  /// @param feedrate  programmed feedrate V_NC > 0 [mm/s]
  double limit_at(const LocalGeometry& at, double feedrate, bool is_fitted) const noexcept {
    const FeedrateRule rule = is_fitted ? on_curves_ : elsewhere_;
    return rule == FeedrateRule::kServoModel
               ? curvature_feedrate(at.curvature, feedrate, model_, limits_)
               : limit_by(rule, at, feedrate);
  }

  /// Whether `level` and `turning` of a place count, not only its curvature.
  bool needs_turning() const noexcept {
    return model_.feedrate_rule == FeedrateRule::kContactSpeed;
  }

 private:
  double limit_by(FeedrateRule rule, const LocalGeometry& at, double feedrate) const noexcept;

  Limits limits_;
  PlanningModel model_;
  FeedrateRule on_curves_;
  FeedrateRule elsewhere_;
  double chord_error_;
  double period_;
};

}  // namespace twin::feedrate
