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
/// A span whose deviation exceeds its limit is marched again with shorter spans, up to kAttempts
/// times. After that the sharpest vertex of the block that deviates most becomes a corner, which
/// ends the run; another run begins there.
///
/// A span leaves for the sink once enough spans after it are checked. It never changes afterwards,
/// and nothing depends on when points arrive.
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
  /// The next point of the run [mm].
  void push(const Vec3& end);
  /// The run ends at the last point; everything left goes to the sink.
  void finish();

 private:
  /// Of the run under way:
  ///
  ///   kEmpty --start--> kGrowing --corner found--> kCut --its end is reached--> kGrowing, from the
  ///      ^                 |                        |                           corner on
  ///      |              finish                   finish
  ///      |                 v                        |
  ///      '----- end ---- kFinished <----------------'
  ///
  /// In kFinished a run that ends at a corner is followed by another one, still kFinished.
  enum class State : std::uint8_t {
    kEmpty,     ///< there is none
    kGrowing,   ///< its end is not known
    kCut,       ///< it ends at a corner, end_vertex_; more points may follow
    kFinished,  ///< it ends at end_vertex_; no more points follow
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
  std::size_t begin_vertex_ = 0;  // of the run under way
  std::size_t end_vertex_ = 0;    // of the run under way, where it is closed
  int attempts_ = 0;              // to march the same place again
};

}  // namespace twin::geometry
