#pragma once

#include <cstddef>
#include <optional>

#include "core/vec.hpp"
#include "geometry/nurbs/span_cubic.hpp"
#include "geometry/smoothing/knot_marcher.hpp"
#include "geometry/smoothing/quasi_interpolant.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

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

/// Checks the spans of a run's spline one after the other, and keeps those whose deviation from the
/// polygon is within its limit. The last kHeldSpans of them are held back, because a later span
/// that fails the check may change them.
class SpanChecker {
 public:
  /// @param tolerance  tolerance of the path; the limit of the deviation is a share of it [mm]
  void start(double tolerance) noexcept { tolerance_ = tolerance; }
  void begin_run() { spans_.restart(0); }

  /// Computes a bound of the deviation of the next span (chord_deviation), and appends the span if
  /// the bound is within the limit or if the span has the shortest length that is allowed.
  ///
  /// @param block  index of the block that contains the begin of the span
  /// @returns nothing if the span was appended, else the block that deviates most
  std::optional<std::size_t> append(const SpanCubic& cubic, const Stretch& stretch,
                                    std::size_t block);

  /// Index of the span that append() takes next.
  std::size_t next() const noexcept { return spans_.end_index(); }
  /// Whether more than kHeldSpans spans are held.
  bool holds_too_many() const noexcept;
  /// Gives the oldest span, or all spans, to the sink. They never change afterwards.
  void release_oldest(RunSink& sink) { release(spans_.begin_index() + 1, sink); }
  void release_all(RunSink& sink) { release(spans_.end_index(), sink); }
  /// Number of spans that the sink has got.
  std::size_t released() const noexcept { return spans_.begin_index(); }

  /// Index of the last knot on which the released spans depend; 0 if there are none.
  std::size_t last_fixed_knot() const noexcept {
    return released() == 0 ? 0 : released() + kReach - 1;
  }

  /// Removes the spans that depend on knots after index `last`.
  void truncate(std::size_t last);

 private:
  struct Span {
    SpanCubic cubic;
    double deviation;  // [mm]
  };

  void release(std::size_t end, RunSink& sink);

  double tolerance_ = 0.0;
  SlidingVector<Span> spans_;
};

}  // namespace twin::geometry
