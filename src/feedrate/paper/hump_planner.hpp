#pragma once

#include <vector>

#include "feedrate/paper/envelope.hpp"
#include "feedrate/planner.hpp"

namespace twin::feedrate {

/// Plans a window as an Envelope of humps. Final is the plan up to the last anchor at its own
/// limit, or hold under a cap, that the end of the window does not slow down.
///
/// From there any feedrate can be reached without acceleration before the horizon, so the next plan
/// can put its anchors where it needs them. Should it fail all the same, humps of the last plan are
/// taken, which only costs time.
class HumpPlanner final : public WindowPlanner {
 public:
  /// @param look_ahead  segments in the window that make a plan due
  HumpPlanner(const RampLimits& ramp, double corner_reach, std::size_t look_ahead)
      : WindowPlanner(corner_reach), ramp_(ramp), envelope_(ramp), look_ahead_(look_ahead) {}

  bool is_due(const Window& window) const override { return window.segments.size() >= look_ahead_; }
  void schedule(const Window& /*window*/) override {}
  void forget(double distance) override;

 private:
  void advance(Window& window, double horizon, Tail tail) override;
  void plan_evenly(const Window& window, double horizon);
  double room_after(const Window& window, const Anchor& anchor, double horizon) const;
  Anchor commit_anchor(const Window& window, double horizon, Tail tail) const;
  void commit(Anchor anchor, Window& window);

  RampLimits ramp_;
  Envelope envelope_;
  std::size_t look_ahead_;
  std::vector<Hump> plan_;  // last feasible plan from the start to rest
};

}  // namespace twin::feedrate
