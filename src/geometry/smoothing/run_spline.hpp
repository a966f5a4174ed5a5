#pragma once

#include <cstddef>
#include <limits>

#include "core/vec.hpp"
#include "geometry/nurbs/span_cubic.hpp"
#include "geometry/smoothing/chord_deviation.hpp"
#include "geometry/smoothing/local_cubic.hpp"
#include "geometry/smoothing/polygon.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

namespace twin::geometry {

/// Takes the pieces of smoothed runs, one after the other.
class RunSink {
 public:
  RunSink() = default;
  RunSink(const RunSink&) = delete;
  RunSink& operator=(const RunSink&) = delete;
  virtual ~RunSink() = default;

  /// The next span of the run's spline.
  /// @param deviation  bound of its distance from the polygon, both ways [mm]
  virtual void take_span(const geometry::SpanCubic& span, double deviation) = 0;
  /// A run of one block, from s = begin to end.
  virtual void take_block(const Vec3& from, const Vec3& to, double begin, double end) = 0;
  /// The run is over; what follows, if anything, meets it at a corner.
  virtual void end_run() = 0;
};

/// Fits a run of short blocks by one C2 cubic spline over the arc length s of their polygon, with
/// as few spans as the tolerance allows, from a stream of points.
///
/// The spline is a quasi-interpolant, corrected once. With
///   Q_j[f] = the blossom at (t_{j+1}, t_{j+2}, t_{j+3}) of the cubic that is nearest to f on
///            [t_{j+1}, t_{j+3}] (LocalCubic),                                                 (1)
/// Q[f] = sum_j Q_j[f] N_j reproduces cubics and averages the rounding of the points, but lies off
/// a curve f by 0.031 H^4 |d4f/ds4| all along. What it makes of itself shows how far:
///   C(s) = sum_j P_j N_j(s),   P_j = 2 Q_j[V] - Q_j[Q[V]].                                     (2)
/// P_j depends on the six spans around it: no system of equations, no effect of a change far away.
///
/// The knots t_j march along the run. A span has the largest length H of H_max 2^-k, at most twice
/// the last one (tried where it is likely to do, and at every fourth span), for which the cubic
/// nearest to the polygon on [t - H, t + 2 H] leaves no more than kShare of the tolerance (root
/// mean square), and that turns by no more
/// than kMostTurn over H, for the curvature of a spline is right to a twelfth of the square of
/// that. Since the window looks ahead and back, spans become short towards a tight place and long
/// behind it.
///
/// At both ends of the run the polygon goes on as its own point reflection, and so do the knots:
/// there C is the end point itself, and C'' = 0.
///
/// Each span has its bound of the deviation (chord_deviation). One that exceeds kLimit of the
/// tolerance is marched over again with shorter spans, kAttempts times at most; then its sharpest
/// vertex becomes a corner, which ends the run and begins another.
///
/// A span is given away once kHeldSpans after it are settled. The spans it is given away with are
/// never marched over again, and nothing depends on when points arrive.
class RunSpline {
 public:
  explicit RunSpline(RunSink& sink) : sink_(sink) {}

  bool is_empty() const noexcept { return !is_open_; }

  /// Begins a run.
  /// @param tolerance  bound of the deviation [mm]
  void start(const Vec3& at, double s, double tolerance);
  /// The next point of the run.
  void push(const Vec3& end);
  /// The run ends at the last point; everything left comes out.
  void finish();

 private:
  struct Knot {
    double s;           // t_j
    std::size_t block;  // that holds it
  };
  struct Span {
    geometry::SpanCubic cubic;
    double deviation;
  };

  std::size_t last_vertex() const noexcept;
  Stretch stretch() const noexcept;
  double run_end() const noexcept { return polygon_[end_vertex_].s; }
  double knot(std::ptrdiff_t j) const noexcept;
  std::size_t last_knot() const noexcept { return knots_.end_index() - 1; }
  bool is_marched() const noexcept { return is_closed_ && knots_.back().s >= run_end(); }
  bool can_settle() const noexcept;
  double longest_span() const noexcept;
  double capped_by_blocks(double width) const noexcept;
  double residual(double width) const noexcept;
  bool can_march() const noexcept;
  void march();
  void advance();
  void add_knot(double s);
  void place_points();
  void correct_points();
  Vec3 refitted(std::size_t point) const noexcept;
  geometry::SpanCubic cubic_of(const SlidingVector<Vec3>& points, std::size_t span) const noexcept;
  void settle();
  void march_again(std::size_t span, std::size_t worst_block);
  bool cut(std::size_t block);
  void truncate(std::size_t knots);
  void give_away(std::size_t end);
  void end_run();
  void begin_at(std::size_t vertex);

  RunSink& sink_;
  double tolerance_ = 0.0;
  Polygon polygon_;
  SlidingVector<Knot> knots_;                             // t_0, t_1, ...
  SlidingVector<Vec3> raw_;                               // Q_{j-3} at index j
  SlidingVector<Vec3> points_;                            // P_{j-3} at index j
  SlidingVector<Span> spans_;                             // settled, not yet given away
  std::size_t begin_vertex_ = 0;                          // of the run under way
  double begin_ = 0.0;                                    // its arc length
  Vec3 begin_at_ = Vec3::Zero();                          // its place
  std::size_t end_vertex_ = 0;                            // where it is closed
  double last_width_ = 0.0;                               // of the latest span; 0: none
  int spans_to_grow_ = 0;                                 // before a longer one is tried
  double cap_ = std::numeric_limits<double>::infinity();  // of spans that begin before cap_end_
  double cap_end_ = 0.0;
  int attempts_ = 0;
  bool is_open_ = false;
  bool is_closed_ = false;    // the end of the run under way is known
  bool is_finished_ = false;  // no more points follow
};

}  // namespace twin::geometry
