#pragma once

#include <span>
#include <vector>

#include "feedrate/paper/envelope.hpp"
#include "feedrate/window_planner.hpp"

namespace twin::feedrate {

/// Settles humps of the Envelope: up to the last knot at its own limit, or hold under a cap, that
/// the end of the window does not slow down.
///
/// From the committed knot any feedrate can be reached with no acceleration before the horizon, so
/// the next plan can put its knots where it needs them. Should one fail all the same, humps of the
/// last one are taken, which only costs time.
class HumpPlanner final : public WindowPlanner {
 public:
  explicit HumpPlanner(const RampLimits& ramp) : ramp_(ramp), envelope_(ramp) {}

  void advance(Window& window, double last, bool is_last) override;
  void forget(double distance) override;

 private:
  std::span<const LimitZone> zones_until(double last) const;
  void plan_evenly(double last);
  double room_after(const Knot& knot, double last) const;
  Knot commit_knot(double last, bool is_last) const;
  void commit(Knot knot);

  RampLimits ramp_;
  Envelope envelope_;
  Window* window_ = nullptr;  // of the call under way
  std::vector<Hump> plan_;    // last feasible plan from the start to rest
};

}  // namespace twin::feedrate
