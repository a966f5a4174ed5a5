#pragma once

#include <span>
#include <vector>

#include "feedrate/paper/envelope.hpp"
#include "feedrate/planner.hpp"

namespace twin::feedrate {

/// Settles humps of the Envelope: up to the last knot at its own limit, or hold under a cap, that
/// the end of the window does not slow down.
///
/// From the committed knot any feedrate can be reached with no acceleration before the horizon, so
/// the next plan can put its knots where it needs them. Should one fail all the same, humps of the
/// last one are taken, which only costs time.
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
  double room_after(const Window& window, const Knot& knot, double horizon) const;
  Knot commit_knot(const Window& window, double horizon, Tail tail) const;
  void commit(Knot knot, Window& window);

  RampLimits ramp_;
  Envelope envelope_;
  std::size_t look_ahead_;
  std::vector<Hump> plan_;  // last feasible plan from the start to rest
};

}  // namespace twin::feedrate
