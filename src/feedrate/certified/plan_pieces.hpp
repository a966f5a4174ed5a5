#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "feedrate/limits/ramp_levels.hpp"
#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"
#include "feedrate/profile/stop.hpp"

namespace twin::feedrate {

/// The parts of a plan within one deceleration and jerk, from which stops are made (profile/stop.hpp).
///
/// A zone allows more deceleration the lower the feedrate is (ramp_levels.hpp). A stop is nowhere faster
/// than the plan, so on each part it may have what the zone allows at the plan's highest feedrate
/// there. The plan changes from level to level within a zone, and so do the parts.
class PlanPieces {
 public:
  /// Divides a plan where its legs end, where the zones' jerk changes, and where the deceleration that
  /// a zone allows at the plan's feedrate does.
  /// @param leg_ends  in path order [mm]
  /// @param zones     cover the plan
  /// @param ramp      limits of the machine
  void find(std::span<const Phase> plan, std::span<const double> leg_ends,
            std::span<const LimitZone> zones, const RampLimits& ramp);

  /// Appends the stretches up to a place, where the plan has no acceleration, and drops their pieces.
  void commit(const Anchor& start, std::vector<Stretch>& stretches);

  /// Follows a shift of the origin of all distances [mm].
  void forget(double distance);

 private:
  /// A part on which the feedrate rises once and falls once at most.
  struct Piece {
    double end;         // [mm]
    double v;           // of the plan there [mm/s]
    double a;           // the same [mm/s^2]
    RampLimits ramp;    // that every place of it allows at the plan's feedrate and below
    double held_above;  // as that of its zone [mm/s]
    bool ends_leg = false;
  };

  void add_all(double begin, double end, double jerk);
  void add(double end, const RampLimits& ramp);
  Stretch stretch_of(std::size_t piece, double last) const;
  double rest_after(std::size_t piece, PathMotion from) const;

  std::vector<Piece> pieces_;
  // While pieces are found:
  std::span<const Phase> plan_;
  RampLimits ramp_{};
  std::size_t phase_ = 0;          // at the end of the last piece
  std::vector<RampLevel> levels_;  // of the zone under way
  double held_above_ = 0.0;        // the same
};

}  // namespace twin::feedrate
