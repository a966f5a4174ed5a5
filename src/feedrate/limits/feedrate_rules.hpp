#pragma once

#include <cstdint>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "path/segment.hpp"

/// V at a place of the path is the least of what the rules below allow there.
namespace twin::feedrate {

/// Geometry of a place of the path, as a feedrate rule sees it.
struct LocalGeometry {
  double curvature = 0.0;  ///< kappa >= 0 [1/mm]
  double level = 1.0;      ///< share of the way that is in the XY plane, sqrt(x'^2 + y'^2), 0..1
  double turning = 0.0;    ///< heading in the XY plane per length of path, left positive [rad/mm]
};

/// The geometry of a place with this tangent and curvature.
///
/// The heading is atan2(y', x'), so its derivative is (x' y'' - y' x'') / (x'^2 + y'^2): on a level
/// path the signed curvature. Where the path is vertical there is no heading and `turning` is 0.
LocalGeometry local_geometry(const path::PathPoint& at) noexcept;

/// Curvature up to which the programmed feedrate V may stay: kappa_critical = a / V^2.
///   [WY09, Eq. 2]
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
/// For 1 - kappa eps <= Kf the model keeps the tolerance at any speed.
///
/// @param curvature  kappa > 0 [1/mm]
/// @returns feedrate limit [mm/s], infinity where the model sets none
double servo_model_feedrate(double curvature, const PlanningModel& model) noexcept;

/// Feedrate limit at a place of a curve by the servo model. Below the critical curvature it is the
/// programmed feedrate; from there on it is Eq. 5 (the two together are Eq. 6), and never more than
/// the normal acceleration kappa v^2 <= A_max allows.
///
/// @param curvature  kappa >= 0 [1/mm]
/// @param feedrate   programmed feedrate V > 0 [mm/s]
double curvature_feedrate(double curvature, double feedrate, const PlanningModel& model,
                          const Limits& limits) noexcept;

/// Feedrate at which the chord between two set points just reaches the chord tolerance.
///
/// The set points of one period T are v T apart. On the osculating circle of radius rho = 1 / kappa
/// the chord is
///   delta = rho - sqrt(rho^2 - (v T / 2)^2)
/// away from the arc at its middle, so
///   v = (2 / T) sqrt(rho^2 - (rho - delta)^2) = (2 / T) sqrt(delta (2 rho - delta)).
/// This is the adaptive feedrate of confined chord error [WY09, refs. 4, 5]. No chord of the circle
/// is farther than rho from it: for rho <= delta there is no limit.
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
/// (G41) touches it at c = q - r n. The projection advances by h = |q'| per length of path, and
/// n' = -(turning) q' / h, so c advances by
///   h + r turning                     on a level path 1 + kappa r, kappa > 0 to the left,
/// and with it z by sqrt(1 - h^2). On the right of the surface r counts negative. Hence
///   V = V_NC / sqrt((h + r turning)^2 + 1 - h^2).
/// For the curvature kappa_c = kappa / (1 + kappa r) of the surface this is V_NC (1 - kappa_c r):
/// slower in inside rounds, faster in outside ones. The rule is that of constant cutter contact
/// velocity [WY09, ref. 6].
///
/// Where h + r turning <= 0 the tool does not fit: it would cut away the surface that it touches.
/// There is no contact speed to keep, and the programmed feedrate stays.
///
/// @param feedrate  programmed feedrate V_NC > 0 [mm/s]
/// @param radius    tool radius r >= 0 [mm]
/// @returns [mm/s], more than V_NC on outside rounds
double contact_speed_feedrate(const LocalGeometry& at, double feedrate, double radius,
                              ToolSide side) noexcept;

/// What a place lies on.
enum class On : std::uint8_t { kCurve, kArcOrLine };

/// The feedrate limit of places of arcs and curves, by the rule of the machine file.
///
///   constant       V_NC and nothing else, not even A_max: what a plain interpolator does
///   chord_error    chord_error_feedrate
///   servo_model    curvature_feedrate, Eqs. 2 to 6
///   contact_speed  contact_speed_feedrate; may exceed V_NC
///   auto           servo_model, but constant on Bezier pieces: Fast Bezier interpolation as
///                  published keeps the programmed feedrate through them
/// All but `constant` also keep the normal acceleration, kappa v^2 <= A_max, and none exceeds the
/// machine's largest feedrate.
class FeedrateRules {
 public:
  /// @param period  interpolation period [s]
  FeedrateRules(Limits limits, const PlanningModel& model, const PathSettings& path, double period);

  /// Limit at a place [mm/s].
  /// @param feedrate  programmed feedrate V_NC > 0 [mm/s]
  double limit_at(const LocalGeometry& at, double feedrate, On what) const noexcept {
    const FeedrateRule rule = what == On::kCurve ? on_curves_ : elsewhere_;
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
