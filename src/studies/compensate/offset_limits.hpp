#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/limits.hpp"
#include "core/vec.hpp"
#include "motion/interpolator/set_point.hpp"
#include "results/metrics/limit_audit.hpp"

namespace twin::studies::compensate {

/// What corrected set points must keep.
struct OffsetLimits {
  Limits machine;         ///< feedrate, acceleration, jerk and travel
  double largest = 0.05;  ///< largest offset of an axis [mm]
  double period = 0.001;  ///< T [s]
};

/// Where set points with offsets exceed a limit, one factor of at least 1 a period: by how much the
/// offsets' share of the peak is too large. With a peak p that is above its limit l, and p0 without
/// the offsets, it is (p - p0) / (l - p0).
struct Excess {
  bool is_kept = true;             ///< no limit is exceeded
  std::vector<double> tangential;  ///< of feedrate and tangential acceleration and jerk
  std::vector<double> normal;      ///< of normal acceleration
};

/// Holds offsets against the limits of the machine.
///
/// Feedrate, acceleration and jerk are judged by the audit of a run (results::LimitAudit), stretch
/// by stretch, once without and once with the offsets. What the plan itself exceeds may stay, but
/// not grow.
class OffsetAudit {
 public:
  OffsetAudit(std::span<const motion::SetPoint> points, const OffsetLimits& limits);

  Excess excess(std::span<const Vec2> offsets) const;
  /// Cuts offsets to their limit and to the travel.
  void clamp(std::vector<Vec2>& offsets) const;
  /// Makes offsets smaller, in smooth dips, until all limits are kept.
  /// @returns false if some rounds did not suffice; the offsets are 0 then
  bool mend(std::vector<Vec2>& offsets) const;

 private:
  /// Peaks of one stretch, and the set points about which they are.
  struct Stretch {
    results::AuditPeaks peaks;
    results::OfEachPeak<std::int64_t> where;
  };
  std::vector<Stretch> audit(std::span<const Vec2> offsets) const;

  std::span<const motion::SetPoint> points_;
  OffsetLimits limits_;
  std::vector<Stretch> plain_;
};

}  // namespace twin::studies::compensate
