#pragma once

#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/certified/bends.hpp"
#include "feedrate/limits/axis_limits.hpp"
#include "feedrate/limits/zones.hpp"
#include "feedrate/planner.hpp"
#include "geometry/nurbs/span_cubic.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

struct ByArcLength;

/// The feedrate limits inside segments with planning.planner = certified. The limits hold at every
/// place of a segment, not only where its curvature was sampled.
///
/// In a zone the limit is the least of
///   the feedrate asked for,
///   the limit of the machine file's rule (FeedrateRules), with kappa v^2 <= A_max,
///   the feedrate at which the chord of a period keeps the chord tolerance (chord_error_feedrate),
///   the feedrate at which the path turns by no more than the set points can tell in a period,
///   the limits of each axis (axis_limits.hpp), where they are set, and of the jerk as a vector.
///
/// The servo model allows two contour errors: the circular error where the path is curved for long,
/// and the larger corner error at a rounded corner, which is a brief bend (bends.hpp).
///
/// Where the jerk of an axis bounds the feedrate in a brief bend, its middle is a place with a lower
/// limit, so that the bend is left with acceleration (path/passage.hpp).
class CertifiedLimits final : public LimitSource {
 public:
  /// @param period  interpolation period [s]
  CertifiedLimits(const Limits& limits, const PlanningModel& model, const PathSettings& path,
                  double period);

  /// Appends the zones of a segment.
  /// @param s0        distance of the segment's start along the path [mm]
  /// @param feedrate  feedrate asked for on the segment [mm/s]
  void append(const path::Segment& segment, double s0, double feedrate,
              std::vector<LimitZone>& zones) override;
  /// Merges zones[first] with the zone before it if both have the same limits.
  void merge(std::vector<LimitZone>& zones, std::size_t first) const override;
  RampLimits least_ramp() const override;
  bool divides_jerk() const override { return has_axis_limits_; }

  /// The zone of a part of a bump at a corner.
  /// @param piece    of the path, by the length of the base path
  /// @param u0, u1   the part
  /// @param s0       distance of its begin along the path [mm]
  /// @param turn     of the whole bump [rad]
  LimitZone zone_of(const geometry::SpanCubic& piece, double u0, double u1, double s0,
                    double feedrate, double turn) const;
  /// The zone of a line or arc that leaves a place of the path.
  LimitZone zone_from(const path::PathPoint& at, double s0, double length, double feedrate) const;

 private:
  /// A zone on one side of the middle of a brief bend.
  struct Beside {
    double begin;      // arc length from the curve's start [mm]
    double end;        // [mm]
    double curvature;  // at most [1/mm]
    double limit;      // [mm/s]
  };

  double any_turn_feedrate() const noexcept;
  double swinging_share() const noexcept;
  double limit_at(const BendInterval& interval, double feedrate, On what) const;
  double dip_limit(const BendPeak& peak, const LimitZone& bend, double feedrate,
                   const Vec3& tangent) const;
  void keep_derivatives(const ByArcLength& begin, const ByArcLength& middle, const ByArcLength& end,
                        BendKind bend, LimitZone& zone) const;
  void keep_axes(const path::FittedCurve& curve, const BendInterval& interval,
                 LimitZone& zone) const;
  void append_brief_bend(const BendPeak& peak, double s0, double feedrate, ZoneRow& row);
  void append_curve(const path::FittedCurve& curve, double s0, double feedrate,
                    std::vector<LimitZone>& zones);
  void append_arc(const path::Segment& segment, double s0, double feedrate,
                  std::vector<LimitZone>& zones) const;

  Limits limits_;
  RampLimits ramp_;
  FeedrateRules lasting_;
  FeedrateRules brief_;
  double chord_error_;
  double period_;
  bool has_axis_limits_;
  bool has_vector_limits_;
  Limits vector_limits_;
  Bends bends_;  // of the curve that is being processed
  std::vector<Beside> beside_;
};

}  // namespace twin::feedrate
