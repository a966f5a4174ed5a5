#pragma once

#include "core/vec.hpp"
#include "geometry/nurbs/span_cubic.hpp"

namespace twin::geometry {

/// Receives the pieces of smoothed runs, one after the other.
class RunSink {
 public:
  RunSink() = default;
  RunSink(const RunSink&) = delete;
  RunSink& operator=(const RunSink&) = delete;
  virtual ~RunSink() = default;

  /// The next span of the run's spline.
  /// @param deviation  bound of its distance from the polygon, both ways [mm]
  virtual void take_span(const SpanCubic& span, double deviation) = 0;
  /// A run of one block, from s = begin to end.
  virtual void take_block(const Vec3& from, const Vec3& to, double begin, double end) = 0;
  /// The run is over; what follows, if anything, meets it at a corner.
  virtual void end_run() = 0;
};

}  // namespace twin::geometry
