#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/fuzz/chain/trajectory.hpp"

namespace twin::fuzz {

/// What is measured of a motion, each as a share of what is allowed: above 1 a promise is broken.
enum class Measure : std::uint8_t {
  kFeedrate,            ///< steps between set points
  kVectorAcceleration,  ///< second differences: of both parts together, sqrt(2) A
  kRawTangential,       ///< second differences of the way on one line or circle
  kRawJerk,             ///< third differences of the way on one line or circle
  kRawNormal,           ///< circle through three set points
  kTangential,          ///< results::LimitAudit, which doubts itself at corners
  kJerk,                ///< the same
  kAxisFeedrate,        ///< differences of single axes
  kAxisAcceleration,
  kAxisJerk,
  kDistance,  ///< of set points from the programmed path, over the tolerance
  kPassed,    ///< ends of blocks that were not passed in their order, 0 or 2
  kTime,      ///< over that of a motion that stops after each block
};
inline constexpr std::size_t kMeasures = 13;

/// Name of a measure, as "raw tangential acceleration".
std::string_view name_of(Measure measure);

/// Shares of what is allowed; NaN where nothing is promised or nothing could be measured.
using Shares = std::array<double, kMeasures>;
inline double& share_of(Shares& shares, Measure measure) {
  return shares[static_cast<std::size_t>(measure)];
}

/// Measures feedrate, accelerations and jerks of a motion by differences of its set points, at rest
/// before the first and after the last.
///
/// A difference of order k over the k-th power of the period is a mean of the k-th derivative, so
/// it never exceeds the true peak. What is subtracted before is the rounding of places.
void measure_limits(const Case& made, const Trajectory& trajectory, Shares& shares);

}  // namespace twin::fuzz
