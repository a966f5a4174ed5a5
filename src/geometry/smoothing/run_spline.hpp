#pragma once

#include <cstddef>
#include <cstdint>

#include "core/vec.hpp"
#include "geometry/smoothing/knot_marcher.hpp"
#include "geometry/smoothing/polygon.hpp"
#include "geometry/smoothing/quasi_interpolant.hpp"
#include "geometry/smoothing/span_checker.hpp"

namespace twin::geometry {

/// Fits a run of short blocks by one C2 cubic spline over the arc length s of their polygon, with
/// as few spans as the tolerance allows, from a stream of points.
///
///   push ----> Polygon ----> KnotMarcher ----> QuasiInterpolant ----> SpanChecker ----> RunSink
///              points,       knots t_j,        control points P_j,    deviation within
///              smooth path   as far apart      curve C(s)             the limit?
///              A(s)          as A(s) lets them                           |
///                                  ^------- shorter spans, or a corner --' no
///
/// If the deviation of a span exceeds its limit, the knots around the span are placed again with
/// shorter spans, up to kAttempts times. If that does not help, the sharper vertex of the block
/// that deviates most becomes a corner. It ends the run, and another run begins there.
///
/// A span is given to the sink once enough spans after it are checked; it never changes afterwards.
/// The result does not depend on when points arrive.
class RunSpline {
 public:
  /// @param sink  receives the spans; it outlives this object
  explicit RunSpline(RunSink& sink) : sink_(sink), interpolant_(knots_) {}
  RunSpline(const RunSpline&) = delete;
  RunSpline& operator=(const RunSpline&) = delete;

  bool is_empty() const noexcept { return state_ == State::kEmpty; }

  /// Begins a run.
  /// @param at         its first point [mm]
  /// @param s          arc length there [mm]
  /// @param tolerance  bound of the deviation [mm]
  void start(const Vec3& at, double s, double tolerance);
  /// Appends the block from the last point of the run to this point [mm].
  void push(const Vec3& end);
  /// Ends the run at the last point and gives all remaining spans to the sink.
  void finish();

 private:
  /// State of the current run:
  ///
  ///   kEmpty --start--> kGrowing --corner found--> kCut --its end is reached--> kGrowing, from the
  ///      ^                 |                        |                           corner on
  ///      |              finish                   finish
  ///      |                 v                        |
  ///      '----- end ---- kFinished <----------------'
  ///
  /// If a run in kFinished ends at a corner, the run after it is in kFinished from its begin.
  enum class State : std::uint8_t {
    kEmpty,     ///< there is no run
    kGrowing,   ///< the end of the run is not known
    kCut,       ///< the run ends at a corner, end_vertex_; more points may follow
    kFinished,  ///< the run ends at end_vertex_; no more points follow
  };

  bool is_closed() const noexcept { return state_ == State::kCut || state_ == State::kFinished; }
  std::size_t last_vertex() const noexcept;
  KnownRun known() const noexcept;
  bool can_check() const noexcept;
  void begin_at(std::size_t vertex);
  void advance();
  void march();
  void check_span();
  void march_again(std::size_t span, std::size_t worst_block);
  bool cut(std::size_t block);
  void truncate(std::size_t last_knot);
  void forget_released();
  void emit_block();
  void end_run();

  RunSink& sink_;
  State state_ = State::kEmpty;
  Polygon polygon_;
  KnotMarcher knots_;
  QuasiInterpolant interpolant_;
  SpanChecker spans_;
  std::size_t begin_vertex_ = 0;  // first vertex of the current run
  std::size_t end_vertex_ = 0;    // last vertex of the current run, in kCut and kFinished
  int attempts_ = 0;              // how often the same knots have been placed again
};

}  // namespace twin::geometry
