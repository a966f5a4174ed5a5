#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "shadow/axis_observer.hpp"
#include "shadow/baseline.hpp"
#include "shadow/cause_trials.hpp"
#include "shadow/evidence.hpp"

namespace twin::shadow {

/// A change that an axis shows.
struct Finding {
  Hypothesis cause;            ///< what explains the residual best
  std::vector<Cause> or_else;  ///< causes that explain it as well and cannot be told from it
  Moment noticed;              ///< when something was sure to have changed
  Moment found;                ///< when this was named
  ChannelKind channel = ChannelKind::kPosition;
  double statistic = 0.0;  ///< the largest, of any cause
  double threshold = 0.0;  ///< that it exceeded
};

/// A point of the strip: the largest statistic of an axis over its threshold.
struct StripPoint {
  double time = 0.0;   ///< [s]
  double level = 0.0;  ///< T / threshold
};

/// Watches one axis and says once what has changed.
///
/// At the end of each block of motion the largest statistic is held against the threshold. A change
/// is announced once one cause explains more of the residual than all others, by a margin and for
/// some blocks in a row; or some time of motion later with all causes that are as good. A force that
/// begins is what many changes begin with, so it is never named before that.
class AxisShadow {
 public:
  /// @param hours  mean time between false alarms [h]. Allocates.
  AxisShadow(AxisObserver observer, const std::vector<ChannelBaseline>& baselines, double period,
             double hours);

  /// One period; allocates where something is announced. @returns whether something new was found
  bool step(const AxisSample& sample, double time, std::int64_t line);

  /// What was found first.
  const std::optional<Finding>& finding() const noexcept { return finding_; }
  /// The same with all that came after it, by which its value is known better.
  std::optional<Finding> last_finding() const;
  /// What the whole run says of each parameter of the position, or of the force.
  struct Estimate {
    ChannelKind channel;
    Cause cause;
    double change;
    double deviation;
  };
  std::vector<Estimate> estimates() const;
  const std::vector<StripPoint>& strip() const noexcept { return strip_; }
  double motion() const noexcept { return now_.moving; }  ///< time in motion [s]
  bool has_failed() const noexcept { return observer_.has_failed(); }
  std::size_t models() const noexcept { return observer_.models(); }

 private:
  struct Channel {
    ChannelBaseline baseline;
    ChannelFilter filter;
    Evidence evidence;
    double threshold;
    PerParameter score{};
    PerParameter information{};
    std::optional<Moment> crossed;  // when the threshold was
    Cause favourite = Cause::kFriction;
    int same = 0;                         // blocks in a row with this favourite
    std::size_t number = 0;               // of the observer's channel
    std::optional<CauseTrials> trials{};  // of counts
    bool moved = false;                   // in the last period
  };
  Finding judge(const Channel& channel) const;
  bool test(Channel& channel);
  void note_level(double level);

  AxisObserver observer_;
  std::vector<Channel> channels_;
  double period_;
  Moment now_;
  std::optional<Finding> finding_;
  std::size_t found_in_ = 0;
  std::vector<StripPoint> strip_;
  std::size_t blocks_a_point_ = 1;
  std::size_t blocks_ = 0;
};

}  // namespace twin::shadow
