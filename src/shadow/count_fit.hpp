#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "shadow/channel_filter.hpp"
#include "shadow/count_filter.hpp"

namespace twin::shadow {

/// Periods of motion of one channel, from some time before a change on.
class CountHistory {
 public:
  static constexpr std::size_t kBefore =
      1500;  ///< periods that are kept before something is noticed
  static constexpr std::size_t kAfter = 3000;  ///< and after that, at most

  struct Period {
    SignalRow row;  ///< less the healthy machine's means
    double direction = 0.0;
    double counts = 0.0;  ///< that passed by
    bool begins = false;  ///< a motion
    bool is_slow = false;
  };

  /// Allocates.
  CountHistory();
  /// Real-time safe.
  void add(const Period& period) noexcept;
  /// From now on the past is kept. Real-time safe.
  void keep() noexcept { is_kept_ = true; }
  /// The past is not kept any more. Real-time safe.
  void release() noexcept {
    is_kept_ = false;
    kept_ = 0;
    size_ = std::min(size_, kBefore);
  }
  /// Periods that were ever added; the last has this number less one.
  std::size_t end() const noexcept { return end_; }
  /// The first that is still there, and the one behind the last.
  std::size_t first() const noexcept { return end_ - size_; }
  const Period& operator[](std::size_t number) const noexcept {
    return periods_[number % periods_.size()];
  }
  bool is_full() const noexcept { return is_kept_ && kept_ >= kAfter; }

 private:
  std::vector<Period> periods_;  // a ring
  std::size_t end_ = 0;
  std::size_t size_ = 0;
  bool is_kept_ = false;
  std::size_t kept_ = 0;
};

/// What explains a stretch of counts.
///
/// Far from the healthy machine slope and curvature of the likelihood say little of a change: the
/// counts bound the level from one side only. So what was noticed is explained by trial: each cause
/// passes a filter of its own, once as a change at once with the force that it begins with, and once
/// as one that grows,
///   r_k - theta (s_k - s_0) - F s_o,k   or   r_k - theta_0 (s_k - s_0) - theta' (t_k - t_0) s_k,
/// and slopes and curvatures correct theta and F until the likelihood of the counts is largest. What a
/// force does in its first periods is not known to a part of a count, so the level may walk there, by
/// as much as the force moves it.
class CountFit {
 public:
  /// Twice the logarithm of the likelihood of a trial, and the change that it takes.
  struct Trial {
    double explained = 0.0;    ///< against no change
    double beside = 0.0;       ///< F [N], or theta at its begin
    double change = 0.0;       ///< theta, or theta' [1/s]
    double information = 0.0;  ///< of it, F being unknown
    bool is_none = false;      ///< nothing has changed
  };

  /// Allocates.
  CountFit(const ChannelBaseline& baseline, const ChannelFacts& facts, double period);

  /// Explains all that there is since period number `begin` by each cause; where the cause is kForce, by the force
  /// alone. Trials begin with what the last ones have found.
  void explain(const CountHistory& history, std::size_t begin);
  /// Shifts `begin` to where a force explains most. @returns it
  std::size_t refine(const CountHistory& history, std::size_t begin, std::size_t range);
  /// Forgets what trials have found.
  void reset() noexcept {
    at_once_ = growing_ = {};
    onset_ = 0.0;
  }
  /// The better one of the two trials of a cause, as a change at the last period.
  Trial best(std::size_t cause) const noexcept;
  double lost() const noexcept { return lost_; }      ///< counts, where they explain it
  double events() const noexcept { return events_; }  ///< at which they were lost
  double passed() const noexcept { return passed_; }

 private:
  enum class Course { kAtOnce, kGrowing };
  struct Sums;
  Sums pass(const CountHistory& history, std::size_t begin, std::size_t cause, Course course,
            const Trial& trial) const;
  Trial improved(const CountHistory& history, std::size_t begin, std::size_t cause, Course course,
                 double nothing, Trial trial) const;
  void count(const CountHistory& history, std::size_t begin, double nothing);

  ChannelBaseline baseline_;
  ChannelFacts facts_;
  double period_;                      // [s]
  std::vector<double> response_step_;  // of the force response, from period to period [um/N]
  std::array<Trial, kCauses> at_once_{};
  std::array<Trial, kCauses> growing_{};
  double onset_ = 0.0;    // force by which the level may walk [N]
  double seconds_ = 0.0;  // from the begin to the last period
  double lost_ = 0.0;
  double events_ = 0.0;
  double passed_ = 0.0;
};

}  // namespace twin::shadow
