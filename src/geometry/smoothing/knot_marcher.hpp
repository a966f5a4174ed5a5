#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "geometry/smoothing/local_cubic.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

namespace twin::geometry {

/// Shortest span of a spline [mm]. A span of this length is accepted however far it deviates, so
/// that halving comes to an end. Twice the length saves one halving. Only a run whose blocks are
/// about as short as this has details of that size.
inline constexpr double kShortestSpan = 1e-4;

/// The part of a run of short blocks that is known so far.
struct KnownRun {
  Stretch stretch;         ///< blocks that have come and do not change any more
  bool is_closed = false;  ///< true: the run ends where the stretch ends; false: more blocks follow
};

/// Places the knots t_0, t_1, ... of a run's spline one after the other, each as far from the one
/// before as the shape of the run permits.
///
/// The next span begins at the knot t. Its length is the largest H = H_max 2^-k for which the cubic
/// that fits the polygon best on [t - H, t + 2 H] (LocalCubic)
///  - is off the polygon by no more than kShare of the tolerance (root mean square), and
///  - turns by no more than kMostTurn over H.
/// H is at most twice the length of the span before. Each trial costs a fit. So a longer span than
/// the one before is tried only where the residual of that one was small, and at every fourth span.
///
///        t-H    t     t+H    t+2H       The window reaches one span back and one ahead, so spans
///    -----|-----|------|------|---      become short before a tight bend, and long after it.
///         '---- window -------'
///
/// Beyond each end of the run the knots go on as a mirror image of those inside.
class KnotMarcher {
 public:
  /// Removes all knots and undoes shorten().
  /// @param tolerance  bound of the deviation of the spline [mm]
  void start(double tolerance) noexcept;

  /// Begins a row of knots with t_0 = s.
  /// @param s      arc length [mm]
  /// @param block  index of the block that contains s
  void begin_at(double s, std::size_t block);

  /// Whether enough of the run is known to place the next knot. The knot does not depend on how
  /// much more is known.
  bool can_march(const KnownRun& run) const noexcept;

  /// Places the next knot. Near the end of a closed run the last spans divide the rest evenly.
  void march(const KnownRun& run);

  /// Whether the knots have reached the end of the run.
  bool is_marched(const KnownRun& run) const noexcept {
    return run.is_closed && knots_.back().s >= run.stretch.end;
  }

  /// Limits the spans around a span to half its length, for when their knots are placed again.
  void shorten(std::size_t span) noexcept;
  /// Arc length up to which shorten() limits spans [mm].
  double shortened_until() const noexcept { return cap_end_; }

  /// t_j of a knot in memory [mm].
  double at(std::size_t j) const noexcept { return knots_[j].s; }
  /// t_j, also for a j beyond the ends of the run, where the knots are mirrored [mm].
  double reflected(std::ptrdiff_t j) const noexcept;
  /// Index of the block that contains knot j.
  std::size_t block(std::size_t j) const noexcept { return knots_[j].block; }
  /// Index of the latest knot.
  std::size_t last() const noexcept { return knots_.end_index() - 1; }
  /// Index of the first knot in memory.
  std::size_t first() const noexcept { return knots_.begin_index(); }

  /// Moments of the run's path over an interval, which are kept for a while: those of the last few
  /// intervals are not computed anew.
  /// @param block  index of a block near its begin
  PathMoments moments(const Stretch& stretch, std::size_t block, double begin, double end) noexcept;

  /// Removes the knots after index `last`.
  void truncate(std::size_t last);
  /// Removes the knots before index j, which are not needed any more.
  void drop_before(std::size_t j) { knots_.drop_before(j); }

 private:
  struct Knot {
    double s;           // t_j [mm]
    std::size_t block;  // index of the block that contains it
  };

  double longest_span() const noexcept;
  double capped_by_blocks(double width, const KnownRun& run) const noexcept;
  double residual(double width, const Stretch& stretch) noexcept;
  void schedule_growth(double residual) noexcept;

  static constexpr std::size_t kKept = 8;  // moments: a window has 3 parts, and some spans fail

  SlidingVector<Knot> knots_;
  std::array<PathMoments, kKept> kept_;
  std::size_t next_kept_ = 0;
  double tolerance_ = 0.0;
  double last_width_ = 0.0;                               // length of the latest span, or 0 [mm]
  int spans_to_grow_ = 0;                                 // spans until a longer one is tried
  double cap_ = std::numeric_limits<double>::infinity();  // longest span before cap_end_ [mm]
  double cap_end_ = 0.0;                                  // arc length [mm]
};

}  // namespace twin::geometry
