#pragma once

#include <cstddef>
#include <vector>

#include "core/limits.hpp"
#include "feedrate/limits/limit_zone.hpp"
#include "feedrate/profile/ramp.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Feedrate limits of the places where segments meet: stops, single corners, and corners so close
/// that a period or a few of them hold several.
class JunctionLimits {
 public:
  /// @param period  interpolation period [s]
  JunctionLimits(const Limits& limits, const PlanningModel& model, double period);

  /// Appends the limit of the place between two segments, if it has one, and lowers those of
  /// corners just before it.
  ///
  /// @param s      the place [mm]
  /// @param zones  all zones before it, of the same measure
  void append(const path::Segment& before, const path::Segment& after, double s,
              std::vector<LimitZone>& zones);

  /// The first zones are gone, and places are measured from a new start.
  /// @param distance  of the new start from the old [mm]
  void forget(double distance, std::size_t zones);

 private:
  struct Turn {
    double s;          // place of the corner [mm]
    double angle;      // [rad]
    std::size_t zone;  // its limit
  };

  void limit_cluster(double turn, double s, std::vector<LimitZone>& zones);

  Limits limits_;
  PlanningModel model_;
  RampLimits ramp_;
  double period_;
  std::vector<Turn> turns_;  // corners that later ones may still limit
};

}  // namespace twin::feedrate
