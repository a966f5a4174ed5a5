#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "feedrate/certified/certified_limits.hpp"
#include "feedrate/certified/zone_ascent.hpp"
#include "path/corner_judge.hpp"

namespace twin::feedrate {

/// Times of a corner with a stop and of one with a bump, from the middle of the one leg to the
/// middle of the other.
///
///   v    ___                 ___        with a bump the feedrate falls to that of its middle, m
///           \               /
///            \ \         / /            with a stop to zero
///             \  `--m--'  /
///      ________\_________/________
///        before    corner   after
///
/// Each leg counts up to its middle, where the feedrate is thought to be at its highest, as it is
/// between two corners that are alike. Mostly bounds in closed form tell which is less: the bump can
/// be passed at m all along. Else the ways up from the corner are planned (ZoneAscent).
class CornerTimes final : public path::CornerJudge {
 public:
  /// @param limits  those inside segments
  /// @param ramp    limits of the machine
  CornerTimes(std::unique_ptr<CertifiedLimits> limits, const RampLimits& ramp)
      : limits_(std::move(limits)), ramp_(ramp) {}

  bool is_stop_quicker(const path::RoundedCorner& corner) override;

 private:
  /// One side, from the corner to the middle of the leg.
  struct Side {
    std::vector<LimitZone> zones;  ///< in path order: those of the bump, and one of the leg
    LimitZone leg;                 ///< as that of the leg, but from the corner on
    double bump = 0.0;             ///< length of half of the bump [mm]
    double rest = 0.0;             ///< of the leg beyond it, up to its middle [mm]
    Sense sense = Sense::kForward;
  };

  void divide(const path::RoundedCorner& corner, double first);
  double time_of(const Side& side, double from);

  std::unique_ptr<CertifiedLimits> limits_;
  RampLimits ramp_;
  Side before_;
  Side after_;
  ZoneAscent up_;
  ZoneAscent down_;
  std::vector<double> shares_;  // of the half width, where zones end
  std::vector<Phase> phases_;
};

}  // namespace twin::feedrate
