#pragma once

#include <span>
#include <vector>

#include "feedrate/certified/glide.hpp"
#include "feedrate/window_planner.hpp"

namespace twin::feedrate {

/// Settles a Glide up to the last place without acceleration that the end of the window does not
/// slow down.
///
/// Every summit but the last ends at a knot at its own limit, so its places are final, and from
/// each of them that has no acceleration the next plan can do as this one did. Of the last summit
/// the way up is final; from there a descent to any lower limit must have room before the window's
/// end, for that may be what the segments to come ask for. Should a plan fail all the same, the
/// last one is followed up to its next place without acceleration: at worst it leads to rest.
class GlidePlanner final : public WindowPlanner {
 public:
  explicit GlidePlanner(const RampLimits& ramp) : ramp_(ramp) {}

  void advance(Window& window, double last, bool is_last) override;
  void forget(double distance) override;

 private:
  /// Place of the plan: so far into one of its phases.
  struct Cut {
    std::size_t phase;
    double time;  // of it [s]
  };

  bool plan(const Window& window, double last);
  bool fall_back(Window& window, double last, bool is_last);
  double descent_to(const Window& window, std::size_t zone, double v, double most);
  double room_after(const Window& window, const Knot& knot, double last);
  Cut last_final(const Window& window, double last);
  Cut next_level() const;
  void commit(Window& window, const Cut& cut);

  RampLimits ramp_;
  RampLimits least_{};    // of all zones of the window
  double fastest_ = 0.0;  // limit of all of them [mm/s]
  Glide glide_;
  Ascent probe_;
  std::vector<Phase> plan_;  // last plan from the start to rest
};

}  // namespace twin::feedrate
