#pragma once

#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/limits/axis_limits.hpp"
#include "feedrate/limits/zones.hpp"
#include "feedrate/planner.hpp"
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
/// and the larger corner error at a rounded corner, called a brief bend here. A bend that turns by
/// phi at curvature kappa is brief if the tangents at its ends meet no farther from the bend than
/// the corner error:
///   (1 / cos(phi / 2) - 1) / kappa <= corner error.
/// One bend ends and the next begins where the curvature has fallen to half of its peak.
///
/// Where the jerk of an axis bounds the feedrate in a brief bend, its middle is a place with a lower
/// limit, so that the bend is left with acceleration (path/passage.hpp).
///
/// The curvature of a FittedCurve is sampled four times on each interval of its arc length, and the
/// intervals are divided until |C'| varies by less than 4 % (geometry/nurbs/arc_length.hpp). Then
/// C' x C'', a polynomial of degree 2, and |C'|^2 exceed the larger of two neighbouring samples by
/// at most 0.3 %.
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

 private:
  struct Interval {
    double begin;  // [mm]
    double end;
    double curvature;         // largest curvature in the interval [1/mm]
    bool is_brief = false;    // part of a brief bend
    bool is_winding = false;  // part of a bend that turns by more than a corner does
  };

  /// The middle of a brief bend.
  struct Peak {
    std::size_t interval;  // begins there
    double half;           // half of the bend's length [mm]
    double room;           // half the way to the next bend of the curve [mm]
  };

  double any_turn_feedrate() const noexcept;
  double most_turn(const Interval& interval) const noexcept;
  double limit_at(const Interval& interval, double feedrate, On what) const;
  void find_intervals(const path::FittedCurve& curve);
  void find_brief_bends();
  void add_peak(std::size_t first, std::size_t last, double turn);
  double dip_limit(const Peak& peak, double limit, double feedrate) const;
  void keep_derivatives(const ByArcLength& begin, const ByArcLength& middle, const ByArcLength& end,
                        BendKind bend, LimitZone& zone) const;
  void keep_axes(const path::FittedCurve& curve, std::size_t interval, LimitZone& zone) const;
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
  double corner_error_;
  bool has_axis_limits_;
  bool has_vector_limits_;
  Limits vector_limits_;
  double least_jerk_;                // of the path and of all axes [mm/s^3]
  std::vector<Interval> intervals_;  // of the curve that is being processed
  std::vector<Peak> peaks_;          // of its brief bends
};

}  // namespace twin::feedrate
