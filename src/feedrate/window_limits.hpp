#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/limits.hpp"
#include "feedrate/limits/corners.hpp"
#include "feedrate/planner.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Where a plan starts: with no acceleration at a place of the first segment.
struct PlanStart {
  double s = 0.0;  ///< from the first segment's start [mm]
  double v = 0.0;  ///< [mm/s]
};

/// Appends the limits of segments to a window as they come: those inside a segment, under the
/// feedrate that is asked for on it, and that of the place where it meets the one before.
class WindowLimits {
 public:
  /// @param source          of the limits inside segments
  /// @param start           of the plan
  /// @param override_scale  of programmed feedrates, > 0; rapids take no more than 1 of it [-]
  WindowLimits(const Limits& limits, const PlanningModel& model, double period,
               std::unique_ptr<LimitSource> source, const PlanStart& start, double override_scale);

  /// Appends the limits of a segment that begins at the window's end.
  void append(const path::Segment& segment, Window& window);

  /// The first zones are gone, and places are measured from a new start.
  /// @param distance  of the new start from the old [mm]
  void forget(double distance, std::size_t zones);

 private:
  double asked_feedrate(const path::Segment& segment) const;
  double reach(const path::Segment& segment, double begin) const;
  void append_passage(const path::Segment& segment, double asked, Window& window);
  void append_descent(const path::Segment& segment, double asked, double down, Window& window);

  Limits limits_;
  std::unique_ptr<LimitSource> source_;
  JunctionLimits junctions_;
  PlanStart start_;
  PlanStart latest_rest_;  // or the start
  RampLimits ramp_;        // of the machine
  double override_scale_;
  std::vector<LimitZone> asked_zones_;  // of one segment, kept for its memory
};

}  // namespace twin::feedrate
