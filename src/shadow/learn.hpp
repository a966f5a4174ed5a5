#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "core/error.hpp"
#include "shadow/baseline.hpp"
#include "shadow/channel_filter.hpp"
#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// One channel of one axis over a recording.
struct ChannelSeries {
  std::vector<SignalRow> rows;
  std::vector<double> counts;     ///< way of the measured position in each period [counts]
  std::vector<char> moves;        ///< whether the axis is in motion there
  std::vector<double> direction;  ///< as Observation has it
  std::vector<double> heading;    ///< the same
  std::vector<char> is_slow;      ///< the same
};

/// Finds what the healthy machine makes of a channel.
///
/// The whitening filter is an autoregression on the residual of the motion; of counts, the noise is
/// what makes the counts most likely. Then the means of the parameters come by least squares over all
/// of it, held near 0 as loosely as the parameters are known at all, and their signatures are taken
/// off; filter and means are found twice. Over windows of 250, 1,000 and 4,000 periods of motion,
/// scores h with information G then tell the excess q and the scatter t of var h = q G + t^2 G^2.
///
/// @param known  deviations of the parameters  @param limit  their largest plausible changes
/// @param precision  gets what is known of each parameter after a second of motion: the inverse of
///                   its variance; 0: nothing. May be null
/// @param stop  ends it once it is set; may be null
/// @returns an error where the motion is too short
Expected<ChannelBaseline> learn_channel(ChannelKind kind, const std::vector<ChannelSeries>& series,
                                        const PerParameter& known, const PerParameter& limit,
                                        const ChannelFacts& facts,
                                        PerParameter* precision = nullptr,
                                        const std::atomic<bool>* stop = nullptr);

/// Least motion of an axis that something can be learnt from, in periods.
inline constexpr std::size_t kLeastMotion = 500;

}  // namespace twin::shadow
