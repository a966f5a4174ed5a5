#pragma once

#include <span>
#include <vector>

#include "feedrate/certified/glide.hpp"
#include "feedrate/planner.hpp"

namespace twin::feedrate {

/// Plans a window as a Glide. Final is the plan up to the last place without acceleration that the
/// end of the window does not slow down.
///
/// Every summit but the last ends at an anchor at its own limit, so its places are final, and from
/// each of them that has no acceleration the next plan can do as this one did. The way up of the
/// last summit is final as far as a descent to any lower limit still has room before the window's
/// end, since the segments to come may ask for it. If a plan fails all the same, the last one is
/// followed up to its next place without acceleration: at worst it leads to rest.
///
/// A plan is due when some braking distances of the path have come, in however many segments.
class GlidePlanner final : public WindowPlanner {
 public:
  /// @param look_ahead  fewest segments between two plans, where their number makes one due
  GlidePlanner(const RampLimits& ramp, double corner_reach, std::size_t look_ahead)
      : WindowPlanner(corner_reach), ramp_(ramp), look_ahead_(look_ahead) {}

  bool is_due(const Window& window) const override;
  void schedule(const Window& window) override;
  void forget(double distance) override;

 private:
  /// The next plan is due when the window has reached one of these.
  struct Due {
    double length = 0.0;  // [mm]
    std::size_t segments = 0;
    std::size_t zones = 1;
  };

  /// Place of the plan: so far into one of its phases.
  struct Cut {
    std::size_t phase;
    double time;  // of it [s]
  };

  void advance(Window& window, double horizon, Tail tail) override;
  bool plan_until(const Window& window, double horizon);
  bool fall_back(Window& window, double horizon, Tail tail);
  double descent_to(const Window& window, std::size_t zone, double v, double most);
  double room_after(const Window& window, const Anchor& anchor, double horizon);
  Cut last_final(const Window& window, double horizon);
  Cut next_level() const;
  void commit(Window& window, const Cut& cut);

  RampLimits ramp_;
  std::size_t look_ahead_;
  Due due_;
  RampLimits least_{};    // of all zones of the window
  double fastest_ = 0.0;  // limit of all of them [mm/s]
  Glide glide_;
  Ascent probe_;
  std::vector<Phase> plan_;  // last plan from the start to rest
};

}  // namespace twin::feedrate
