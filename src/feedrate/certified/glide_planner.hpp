#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "feedrate/certified/passage_glide.hpp"
#include "feedrate/certified/plan_pieces.hpp"
#include "feedrate/planner.hpp"

namespace twin::feedrate {

/// Plans a window with Glide. The plan is final up to the last place without acceleration at which
/// the end of the window does not slow it down yet.
///
/// Every summit but the last one ends at an anchor whose feedrate is the limit there, so segments
/// that follow cannot change it. The ascent of the last summit is final up to the place from which
/// the motion can still slow down to any lower limit before the end of the window, since the
/// segments to come may have such a limit. The next plan starts at a place without acceleration, so
/// it can at least repeat this plan. If it fails all the same, this plan is followed to its next
/// place without acceleration, which is at worst the place of rest at its end.
///
/// A plan is due when some braking distances of path have come, in however many segments.
class GlidePlanner final : public WindowPlanner {
 public:
  /// Where acceleration and jerk are limited.
  enum class Ramps : std::uint8_t {
    kOfMachine,  ///< the same everywhere, so that a stop needs no stretches
    kOfZones     ///< zones may allow less
  };

  /// @param look_ahead  fewest segments between two plans that are due by the number of segments
  GlidePlanner(const RampLimits& ramp, Ramps ramps, double corner_reach, std::size_t look_ahead)
      : WindowPlanner(corner_reach), ramp_(ramp), ramps_(ramps), look_ahead_(look_ahead) {}

  bool is_due(const Window& window) const override;
  void schedule(const Window& window) override;
  void forget(double distance) override;

 private:
  /// The next plan is due when the window reaches one of these sizes.
  struct Due {
    double length = 0.0;  // [mm]
    std::size_t segments = 0;
    std::size_t zones = 1;
  };

  /// A place of the plan.
  struct Cut {
    std::size_t phase;  // index of the phase
    double time;        // time since the begin of the phase [s]
  };

  void advance(Window& window, double horizon, Tail tail) override;
  bool plan_until(std::span<const LimitZone> zones, const Anchor& start, double horizon);
  void plan_evenly(const Window& window, double horizon);
  bool fall_back(Window& window, double horizon, Tail tail);
  double descent_to(const Window& window, std::size_t zone, double v, double most);
  double descent_at(const Window& window, double horizon, double v) const;
  double room_after(const Window& window, const Anchor& anchor, double horizon);
  Cut last_final(const Window& window, double horizon);
  Cut next_level() const;
  void commit(Window& window, const Cut& cut);

  RampLimits ramp_;
  Ramps ramps_;
  std::size_t look_ahead_;
  Due due_;
  RampLimits least_{};    // of all zones of the window
  double fastest_ = 0.0;  // limit of all of them [mm/s]
  PassageGlide glide_;
  Ascent probe_;
  ZoneAscent zone_probe_;
  std::vector<LimitZone> calmed_;  // zones of a plan, where places limit the jerk beside them
  std::vector<Phase> plan_;        // last plan from the start to rest
  PlanPieces pieces_;              // of plan_, where zones have ramps of their own
};

}  // namespace twin::feedrate
