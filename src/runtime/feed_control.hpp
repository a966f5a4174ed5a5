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

/// Feed override and feed hold in the motion thread, and how a path that was braked goes on.
///
/// A feed hold brakes on the path at once. Everything else needs another plan, which planning is
/// asked for: a changed override needs one from a place ahead, and a motion at rest needs one from
/// the place of rest. Set points come from one plan or the other, or from braking; nothing scales
/// their time.
///
///   following --ask--> asked --accept--> armed ---------> following     in motion
///                            \-accept--> priming -------> following     at rest
///
/// In lockstep the answer is there at once. On the wall clock an offer that comes too late is
/// rejected, and the next request leaves more room.
class FeedControl {
 public:
  struct Options {
    std::vector<OverrideChange> schedule{};
    feedrate::RampLimits ramp;  ///< for braking
    double period = 0.001;      ///< [s]
    bool is_wall_clock = false;
    double first_percent = 100.0;  ///< override that the first plan is made for [%]
    double feedrate = 200.0;       ///< largest of the machine [mm/s]
  };

  FeedControl(motion::Interpolator& interpolator, const PlanSupply& supply, Replanning& replanning,
              OperatorPanel& panel, const Options& options);

  /// Looks at what is wanted, before each set point. Real-time safe on the wall clock.
  /// @param t  time since the first set point [s]
  void update(double t) noexcept;
  /// Whether the rest on the path is one that the operator asked for, a part of the motion's time.
  bool is_hold() const noexcept { return is_hold_; }
  /// Shows the motion on the panel. Real-time safe.
  void show(const results::Sample& sample) noexcept;
  void show_end() noexcept;

  /// The changes, in their order.
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
  double percent_ = 100.0;       // that the plan followed is made for [%]
  double asked_percent_ = 100.0;
  bool asked_at_rest_ = false;
  OperatorPanel::Wish wish_;
  double wished_at_ = 0.0;  // since when [s]
  double margin_;           // [s]
  bool is_hold_ = false;
  bool rests_first_ = false;  // no place ahead suited
  std::vector<results::OverrideRecord> records_;
};

/// The override that the first plan is to be made for [%]. The schedule's changes at the first set
/// point go to the panel.
double first_override(const std::vector<OverrideChange>& schedule, OperatorPanel& panel) noexcept;

}  // namespace twin::runtime
