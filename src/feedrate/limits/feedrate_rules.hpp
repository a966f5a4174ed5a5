#pragma once

#include <cstdint>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "path/segment.hpp"

/// Rules that limit the feedrate V at one place of the path, from the geometry of the path there.
namespace twin::feedrate {

/// What the feedrate rules use of the geometry at one place of the path.
struct LocalGeometry {
  double curvature = 0.0;  ///< kappa >= 0 [1/mm]
  double level = 1.0;      ///< XY part of the unit tangent, sqrt(x'^2 + y'^2): 1 level, 0 vertical
  double turning = 0.0;    ///< heading in the XY plane per length of path, left positive [rad/mm]
};

/// The local geometry at a point of the path.
///
/// The heading is atan2(y', x'), so its derivative is (x' y'' - y' x'') / (x'^2 + y'^2). On a level
/// path this is the signed curvature. A vertical path has no heading, and `turning` is 0 there.
LocalGeometry local_geometry(const path::PathPoint& at) noexcept;

/// Largest curvature at which the programmed feedrate V keeps the normal acceleration a:
///   kappa_critical = a / V^2.
///   [WY09, Eq. 2]
/// @param acceleration  a > 0 [mm/s^2]
/// @param feedrate      V > 0 [mm/s]
/// @returns [1/mm]
double critical_curvature(double acceleration, double feedrate) noexcept;

/// Feedrate at which the servo model's circular contouring error just reaches its tolerance.
///
/// A first-order loop with feedforward, gains Kp and Kf, follows a circle of curvature kappa at
/// angular velocity w on a radius that is too small by eps:
///   kappa eps = 1 - sqrt((Kf^2 w^2 + Kp^2) / (w^2 + Kp^2))
///   [WY09, Eq. 3]
/// which for w gives
///   w = Kp sqrt((1 - (1 - kappa eps)^2) / ((1 - kappa eps)^2 - Kf^2)),  V = w / kappa
///   [WY09, Eqs. 4, 5]
/// If 1 - kappa eps <= Kf, the error of the model stays within the tolerance at any speed.
///
/// @param curvature  kappa > 0 [1/mm]
/// @param model      gains Kp and Kf, and the tolerance eps
/// @returns feedrate limit [mm/s], infinity where the model sets none
double servo_model_feedrate(double curvature, const PlanningModel& model) noexcept;

/// Feedrate limit by the servo model at a place of a curve.
///
/// Up to the critical curvature the limit is the programmed feedrate. Above it the limit is that of
/// servo_model_feedrate() (Eq. 5; both cases together are Eq. 6). The limit never exceeds the
/// feedrate at which the normal acceleration kappa v^2 reaches A_max.
///
/// @param curvature  kappa >= 0 [1/mm]
/// @param feedrate   programmed feedrate V > 0 [mm/s]
/// @returns [mm/s]
double curvature_feedrate(double curvature, double feedrate, const PlanningModel& model,
                          const Limits& limits) noexcept;

/// Feedrate limit by the servo model that never falls where the programmed feedrate rises.
///
/// As curvature_feedrate(), but whether a place of a curve is critical does not depend on the
/// programmed feedrate: Eq. 2 has model.critical_feedrate in its place. So the limit is the
/// programmed feedrate or a limit that the place alone has, whichever is less. With Eq. 2 as
/// published a bend becomes critical, and much slower, when the programmed feedrate gets so high
/// that the bend takes all of A_max.
///
/// @param curvature  kappa >= 0 [1/mm]
/// @param feedrate   programmed feedrate V > 0 [mm/s]
/// @returns [mm/s]
double monotone_curvature_feedrate(double curvature, double feedrate, const PlanningModel& model,
                                   const Limits& limits) noexcept;

/// Feedrate at which the chord between two set points just reaches the chord tolerance.
///
/// Two successive set points are v T apart. With the path replaced by its osculating circle of
/// radius rho = 1 / kappa, the middle of the chord between them is
///   delta = rho - sqrt(rho^2 - (v T / 2)^2)
/// away from the arc, so
///   v = (2 / T) sqrt(rho^2 - (rho - delta)^2) = (2 / T) sqrt(delta (2 rho - delta)).
/// This is the adaptive feedrate of confined chord error [WY09, refs. 4, 5]. No chord is farther
/// than rho from its circle, so for rho <= delta there is no limit.
///
/// @param curvature    kappa >= 0 [1/mm]
/// @param chord_error  delta > 0 [mm]
/// @param period       interpolation period T > 0 [s]
/// @returns [mm/s]; infinity where the rule sets no limit
double chord_error_feedrate(double curvature, double chord_error, double period) noexcept;

/// Feedrate of the tool's centre at which its point of contact moves along the surface at the
/// programmed feedrate.
///
/// The path is that of the centre of a cylinder of radius r whose axis is Z. With q the path's
/// projection into the XY plane and n its normal to the left, a tool on the left of the surface
/// (G41) touches the surface at c = q - r n. Per length of path the projection advances by
/// h = |q'|, the normal changes by n' = -(turning) q' / h, and so the point of contact advances by
///   h + r turning                     on a level path 1 + kappa r, kappa > 0 to the left,
/// in the plane, and by sqrt(1 - h^2) along Z. For a tool on the right of the surface r is replaced
/// by -r. Hence
///   V = V_NC / sqrt((h + r turning)^2 + 1 - h^2).
/// For the curvature kappa_c = kappa / (1 + kappa r) of the surface this is V_NC (1 - kappa_c r):
/// the tool's centre is slower in inside rounds and faster on outside rounds. The rule is that of
/// constant cutter contact velocity [WY09, ref. 6].
///
/// Where h + r turning <= 0 the tool does not fit: it would cut away the surface that it touches.
/// Then no contact speed can be kept, and the result is the programmed feedrate.
///
/// @param feedrate  programmed feedrate V_NC > 0 [mm/s]
/// @param radius    tool radius r >= 0 [mm]
/// @returns [mm/s], more than V_NC on outside rounds
double contact_speed_feedrate(const LocalGeometry& at, double feedrate, double radius,
                              ToolSide side) noexcept;

/// The kind of segment that a place lies on.
enum class On : std::uint8_t { kCurve, kArcOrLine };

/// The feedrate limit at a place of the path, by the rule that the machine file chooses.
///
///   constant       V_NC alone, without regard to A_max, as a plain interpolator does
///   chord_error    chord_error_feedrate
///   servo_model    curvature_feedrate, Eqs. 2 to 6; with the certified planner
///                  monotone_curvature_feedrate
///   contact_speed  contact_speed_feedrate; may exceed V_NC
///   auto           servo_model, but constant on Bezier pieces: Fast Bezier interpolation as
///                  published keeps the programmed feedrate through them
/// All rules but `constant` also keep the normal acceleration kappa v^2 within A_max. No rule
/// exceeds the machine's largest feedrate.
class FeedrateRules {
 public:
  /// @param period  interpolation period [s]
  FeedrateRules(Limits limits, const PlanningModel& model, const PathSettings& path, double period);

  /// Limit at a place [mm/s].
  /// @param feedrate  programmed feedrate V_NC > 0 [mm/s]
  double limit_at(const LocalGeometry& at, double feedrate, On what) const noexcept {
    const FeedrateRule rule = what == On::kCurve ? on_curves_ : elsewhere_;
    return rule == FeedrateRule::kServoModel ? servo_limit(at.curvature, feedrate)
                                             : limit_by(rule, at, feedrate);
  }

  /// Whether the rule uses `level` and `turning` of a place, besides its curvature.
  bool needs_turning() const noexcept {
    return model_.feedrate_rule == FeedrateRule::kContactSpeed;
  }

 private:
  double servo_limit(double curvature, double feedrate) const noexcept {
    return planner_ == Planner::kPaper
               ? curvature_feedrate(curvature, feedrate, model_, limits_)
               : monotone_curvature_feedrate(curvature, feedrate, model_, limits_);
  }
  double limit_by(FeedrateRule rule, const LocalGeometry& at, double feedrate) const noexcept;

  Limits limits_;
  PlanningModel model_;
  Planner planner_;
  FeedrateRule on_curves_;
  FeedrateRule elsewhere_;
  double chord_error_;
  double period_;
};

}  // namespace twin::feedrate
