#pragma once

#include <cmath>
#include <cstdint>

#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// Incremental encoder behind a counter: whole counts since zero().
///
/// With the scale c [mm/count] and the phase p in [0, 1) the counter shows
///   n = floor((x - x_0) / c + p)
/// p = 0.5 puts the zero in the middle of a count, so that standing there is no error.
class Encoder {
 public:
  explicit Encoder(const EncoderParams& params) noexcept
      : mm_per_count_(params.mm_per_count), phase_(params.phase) {}

  /// Makes a position zero counts. @param position [mm]
  void zero(double position) noexcept { origin_ = position; }
  /// Counts at a finite position [mm]. Real-time safe.
  std::int64_t counts(double position) const noexcept {
    return static_cast<std::int64_t>(std::floor((position - origin_) / mm_per_count_ + phase_));
  }
  /// Position that is zero counts [mm].
  double origin() const noexcept { return origin_; }

 private:
  double mm_per_count_;
  double phase_;
  double origin_ = 0.0;
};

}  // namespace twin::hal::mujoco
