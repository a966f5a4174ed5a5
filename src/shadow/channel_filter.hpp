#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "shadow/baseline.hpp"
#include "shadow/count_filter.hpp"
#include "shadow/jump_finder.hpp"
#include "shadow/onset_bank.hpp"
#include "shadow/whitener.hpp"

namespace twin::shadow {

/// What a channel's filter must know of the axis.
struct ChannelFacts {
  double count = 0.0;  ///< width of a count, and step of the residual by a lost one [um]; 0: none
  double hum_angle = 0.0;              ///< 2 pi f T of a hum; 0: none
  std::vector<double> force_response;  ///< of the residual to 1 N, period by period; may be empty
};

/// Makes rows whose likelihood is known of a channel's residuals: by the counts, or by a whitener for
/// residuals that are noise.
class ChannelFilter {
 public:
  /// Allocates.
  ChannelFilter(const ChannelBaseline& baseline, const ChannelFacts& facts);

  struct Output {
    bool has_row = false;
    WhiteRow row;
    JumpFinder::Found jumps;  ///< that were found in this period
  };
  /// One period. Real-time safe. @param moves  whether the axis is in motion
  /// @param direction  of the motion JumpFinder::kMemory - 1 periods ago; 0 where it was slow
  /// @param heading    the same of now
  /// @param is_slow    friction may hold the axis now
  Output step(const SignalRow& raw, bool moves, double direction, double heading,
              bool is_slow) noexcept;

  /// A residual less that of the healthy machine's parameters. Real-time safe.
  SignalRow healthy(SignalRow raw) const noexcept;
  /// Forces that began, where the filter looks for them so; else null.
  const OnsetBank* onsets() const noexcept { return onsets_ ? &*onsets_ : nullptr; }

 private:
  PerParameter mean_;
  double variance_;
  double slow_;
  std::optional<CountFilter> counts_;
  std::optional<OnsetBank> onsets_;
  std::optional<Whitener> whitener_;
  std::optional<JumpFinder> jumps_;
};

}  // namespace twin::shadow
