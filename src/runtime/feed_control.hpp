#pragma once

#include <cstdint>
#include <vector>

#include "feedrate/profile/ramps.hpp"
#include "motion/interpolator/interpolator.hpp"
#include "results/metrics/summary.hpp"
#include "results/trace/sample.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/override_schedule.hpp"
#include "runtime/replanning.hpp"

namespace twin::runtime {

/// Carries out feed override and feed hold in the motion thread, and starts the motion again after
/// it has braked to rest on the path.
///
/// A feed hold brakes on the path at once. Everything else needs another plan, which this class
/// asks the planning for. A changed override needs a plan that takes over at a place ahead; a
/// motion at rest needs one that starts at the place of rest. Every set point comes from a plan or
/// from braking. The time of a plan is never stretched.
///
///   following --ask--> asked --accept--> armed ---- place of the switch ---> following
///                        |
///                        '-- accept, at rest --> priming -- path planned --> following
///
/// In lockstep the answer to a request is there at once. On the wall clock an offer may come too
/// late. It is then rejected, and the next request leaves more time.
class FeedControl {
 public:
  struct Options {
    std::vector<OverrideChange> schedule{};
    feedrate::RampLimits ramp;  ///< for braking
    double period = 0.001;      ///< [s]
    bool is_wall_clock = false;
    double first_percent = 100.0;  ///< override that the first plan is made for [%]
    double feedrate = 200.0;       ///< largest feedrate of the machine [mm/s]
  };

  FeedControl(motion::Interpolator& interpolator, const PlanSupply& supply, Replanning& replanning,
              OperatorPanel& panel, const Options& options);

  /// Compares what schedule and panel want with what is done, and acts. It is called before each
  /// set point. Real-time safe on the wall clock.
  /// @param t  time since the first set point [s]
  void update(double t) noexcept;
  /// Rejects an offer that has come while the motion waits for a segment. The planning waits for the
  /// answer before it goes on, so without one both would wait for ever. Real-time safe.
  void decline() noexcept;
  /// Whether the motion rests because the operator asked for it. Such a rest is a part of the
  /// motion and is recorded; a rest for lack of planned path is not.
  bool is_hold() const noexcept { return is_hold_; }
  /// Shows the motion on the panel. Real-time safe.
  void show(const results::Sample& sample) noexcept;
  /// Shows on the panel that the motion has ended. Real-time safe.
  void show_end() noexcept;

  /// The changes of the override that took effect, in order of time.
  const std::vector<results::OverrideRecord>& records() const noexcept { return records_; }

 private:
  enum class State : std::uint8_t { kFollowing, kAsked, kArmed, kPriming };

  void apply_schedule(double t) noexcept;
  OperatorPanel::Wish wish_at(double t) noexcept;
  void brake_for_hold(double t) noexcept;
  void ask(double percent) noexcept;
  void look_at_offer(bool holds) noexcept;
  double least_margin() const noexcept;
  bool accept(const ReplanOffer& offer) noexcept;
  void follow_up(double t, bool holds) noexcept;
  void record(const results::OverrideRecord& change) noexcept;

  motion::Interpolator& interpolator_;
  const PlanSupply& supply_;
  Replanning& replanning_;
  OperatorPanel& panel_;
  Options options_;
  State state_ = State::kFollowing;
  std::size_t next_change_ = 0;  // of the schedule
  double percent_ = 100.0;       // override that the present plan is made for [%]
  double asked_percent_ = 100.0;
  bool asked_at_rest_ = false;
  OperatorPanel::Wish wish_;
  double wished_at_ = 0.0;  // time at which wish_ last changed [s]
  double margin_;           // least time from a request to the place of its switch [s]
  bool is_hold_ = false;
  bool rests_first_ = false;  // no place ahead is fit for a switch, so the motion brakes first
  std::vector<results::OverrideRecord> records_;
};

/// Returns the override that the first plan is to be made for [%]. Changes that the schedule has at
/// time 0 are entered on the panel.
double first_override(const std::vector<OverrideChange>& schedule, OperatorPanel& panel) noexcept;

}  // namespace twin::runtime
