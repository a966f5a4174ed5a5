#pragma once

#include <array>
#include <cstddef>

#include "shadow/count_fit.hpp"
#include "shadow/evidence.hpp"

namespace twin::shadow {

/// Explains what was noticed in the counts of one channel, until it is named.
class CauseTrials {
 public:
  /// Allocates.
  CauseTrials(const ChannelBaseline& baseline, const ChannelFacts& facts, double period);

  /// A period of motion. Real-time safe until something is noticed.
  void add(const CountHistory::Period& period) noexcept { history_.add(period); }
  /// Something was noticed, or is to be explained again with what has come since.
  /// @param by_evidence  what Evidence has of each cause  @param waited  since it was noticed [s]
  void explain(const std::array<Hypothesis, kCauses>& by_evidence, const Moment& now,
               double waited);
  /// What was noticed was nothing: waits for what is noticed next. Real-time safe.
  void restart() noexcept;
  /// Whether there are explanations.
  bool has_explained() const noexcept { return explained_to_ > 0; }
  /// What the trials say of each cause.
  std::array<Hypothesis, kCauses> hypotheses() const noexcept;
  /// By so much must one of them lead.
  double margin_of(const Hypothesis& best) const noexcept;

 private:
  ChannelBaseline baseline_;
  double period_;
  CountHistory history_;
  CountFit fit_;
  std::size_t begin_ = 0;
  Moment since_;
  bool has_begun_ = false;
  std::size_t explained_to_ = 0;  // period of the history; 0: nothing was explained
};

}  // namespace twin::shadow
