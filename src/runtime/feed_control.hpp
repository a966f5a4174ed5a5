#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "feedrate/profile/ramp_limits.hpp"
#include "motion/interpolator/interpolator.hpp"
#include "results/metrics/summary.hpp"
#include "results/trace/sample.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/override_schedule.hpp"
#include "runtime/replan_link.hpp"
#include "runtime/segment_queue.hpp"

namespace twin::runtime {

/// Feed override and feed hold in the motion thread, and how a path that was braked goes on.
///
/// A feed hold brakes on the path at once. Everything else asks the planning thread for another
/// plan: a changed override from a place ahead, going on from rest from where that is. Set points
/// come from one plan or the other, or from braking; nothing scales their time.
///
///   following --ask--> asked --accept--> armed ---------> following     in motion
///                            \-accept--> priming -------> following     at rest
///
/// Off the wall clock it waits for the planning thread's answer, so that nothing depends on which
/// thread is faster. On it an offer that comes too late is rejected, and the next request leaves
/// more room.
class FeedControl {
 public:
  struct Options {
    std::vector<OverrideChange> schedule;
    feedrate::RampLimits ramp;  ///< for braking
    double period = 0.001;      ///< [s]
    bool is_wall_clock = false;
    double feedrate = 200.0;  ///< largest of the machine [mm/s]
  };

  FeedControl(motion::Interpolator& interpolator, SegmentQueue& segments, ReplanLink& link,
              OperatorPanel& panel, const Options& options);

  /// Before each set point. Real-time safe on the wall clock. @param t since the first set point
  /// [s]
  /// @param stop  ends waiting
  void update(double t, const std::atomic<bool>& stop);
  /// Whether the rest on the path is one that the operator asked for, a part of the motion's time.
  bool is_hold() const noexcept { return is_hold_; }
  /// Shows the motion on the panel. Real-time safe.
  void show(const results::Sample& sample) noexcept;
  void show_end() noexcept;

  /// What the first plan is made for [%].
  double first_percent() const noexcept { return first_percent_; }
  /// The changes, in their order.
  const std::vector<results::OverrideRecord>& records() const noexcept { return records_; }

 private:
  enum class State : std::uint8_t { kFollowing, kAsked, kArmed, kPriming };

  void take_schedule(double t) noexcept;
  OperatorPanel::Wish wish_at(double t) noexcept;
  void brake_for_hold(double t) noexcept;
  void ask(double percent);
  void look_at_offer(bool holds) noexcept;
  double least_margin() const noexcept;
  bool accept(const ReplanOffer& offer) noexcept;
  void follow_up(double t, bool holds) noexcept;
  void record(const results::OverrideRecord& change) noexcept;

  motion::Interpolator& interpolator_;
  SegmentQueue& segments_;
  ReplanLink& link_;
  OperatorPanel& panel_;
  Options options_;
  State state_ = State::kFollowing;
  std::size_t next_change_ = 0;  // of the schedule
  double first_percent_ = 100.0;
  double percent_ = 100.0;  // that the plan followed is made for [%]
  double asked_percent_ = 100.0;
  bool asked_at_rest_ = false;
  OperatorPanel::Wish wish_;
  double wished_at_ = 0.0;  // since when [s]
  double margin_;           // [s]
  bool is_hold_ = false;
  bool rests_first_ = false;  // no place ahead suited
  std::vector<results::OverrideRecord> records_;
};

}  // namespace twin::runtime
