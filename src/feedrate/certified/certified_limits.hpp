#pragma once

#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/limits/feedrate_rule.hpp"
#include "feedrate/limits/limit_zone.hpp"
#include "feedrate/planner.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// The feedrate limits inside segments with planning.planner = certified: between the places where
/// the curvature is known, not only at them.
///
/// In a zone the limit is the least of
///   the feedrate asked for
///   the rule's limit (feedrate_rule.hpp), normal acceleration kappa v^2 <= A_max with it
///   the chord error of a period (chord_limit.hpp)
///   the limits of each axis (axis_limits.hpp), where they are set.
///
/// A bend that rounds a corner within the corner error may err by the corner error; only curvature
/// that lasts is held to the circular error. A bend of turn phi and curvature kappa is that brief
/// where the corner of the tangents at its ends is near it:
///   (1 / cos(phi / 2) - 1) / kappa <= corner error.
/// Bends are told apart where the curvature falls to half of its peak.
///
/// Where axes have limits of their own, a brief bend is one zone with its lowest limit: little A
/// and J is left in it, and as a valley it is passed at one feedrate, so that the ramps beside it
/// need not do with that little.
///
/// The curvature of a FittedCurve is sampled four times on each interval of its arc length, and
/// those are divided until |C'| varies by less than 4 % (nurbs/arc_length.hpp); then C' x C'', a
/// polynomial of degree 2, and |C'|^2 are within 0.3 % of the larger end between two samples.
class CertifiedLimits final : public LimitSource {
 public:
  /// @param period  interpolation period [s]
  CertifiedLimits(const Limits& limits, const PlanningModel& model, const PathSettings& path,
                  double period);

  /// Appends the zones of a segment that begins at s0.
  /// @param feedrate  asked for on it [mm/s]
  void append(const path::Segment& segment, double s0, double feedrate,
              std::vector<LimitZone>& zones) override;
  /// Makes the zone part of the one before it where both have the same limits.
  void merge(std::vector<LimitZone>& zones, std::size_t first) const override;
  RampLimits least_ramp() const override;
  bool has_zone_ramps() const override { return has_axis_limits_; }

 private:
  struct Interval {
    double begin;  // [mm]
    double end;
    double curvature;  // largest in it [1/mm]
    bool is_brief;
    bool is_held;  // passed at one feedrate with the interval before it
  };

  double limit_at(const Interval& interval, double feedrate, bool is_fitted) const;
  void take_intervals(const path::FittedCurve& curve);
  void find_brief_bends();
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
  std::vector<Interval> intervals_;  // of the curve at hand
};

}  // namespace twin::feedrate
