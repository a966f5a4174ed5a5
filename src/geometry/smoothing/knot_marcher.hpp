#pragma once

#include <cstddef>
#include <limits>

#include "geometry/smoothing/local_cubic.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

namespace twin::geometry {

/// A span of this length is accepted however far it deviates [mm], so that halving comes to an end.
/// Twice the length saves one halving, and the polygon of a run has details of that size only where
/// its blocks are specks.
inline constexpr double kShortestSpan = 1e-4;

/// What is known of a run of short blocks.
struct KnownRun {
  Stretch stretch;         ///< the blocks that are there and do not change any more
  bool is_closed = false;  ///< the run ends where the stretch ends; otherwise more blocks follow
};

/// Places the knots t_0, t_1, ... of a run's spline one after the other.
///
/// The next span has the largest length H = H_max 2^-k for which the cubic that is nearest to the
/// polygon on [t - H, t + 2 H] (LocalCubic)
///  - leaves no more than kShare of the tolerance (root mean square), and
///  - turns by no more than kMostTurn over H.
/// H is at most twice the length of the span before. A span that is longer than the one before is
/// tried where the residual says that it is likely to fit, and at every fourth span.
///
///        t-H    t     t+H    t+2H       The window reaches one span back and one ahead, so spans
///    -----|-----|------|------|---      become short before a tight place, and long behind it.
///         '---- window -------'
///
/// Beyond both ends of the run the knots are those inside, reflected about the end.
class KnotMarcher {
 public:
  /// Forgets all knots and shortenings.
  /// @param tolerance  bound of the deviation of the spline [mm]
  void start(double tolerance) noexcept;

  /// Begins a row of knots with t_0 = s, in a block of the polygon.
  void begin_at(double s, std::size_t block);

  /// Whether enough of the run is known to place the next knot. Nothing depends on how much more is
  /// known.
  bool can_march(const KnownRun& run) const noexcept;

  /// Places the next knot. Near the known end of a run the spans divide the rest evenly.
  void march(const KnownRun& run);

  /// Whether the knots have reached the end of the run.
  bool is_marched(const KnownRun& run) const noexcept {
    return run.is_closed && knots_.back().s >= run.stretch.end;
  }

  /// Makes the spans around this one at most half as long when they are marched again.
  void shorten(std::size_t span) noexcept;
  /// Arc length up to which spans are shortened [mm].
  double shortened_until() const noexcept { return cap_end_; }

  /// t_j of a knot that is placed and not forgotten [mm].
  double at(std::size_t j) const noexcept { return knots_[j].s; }
  /// t_j, also of the reflected knots beyond the ends of the run [mm].
  double reflected(std::ptrdiff_t j) const noexcept;
  /// The block that holds knot j.
  std::size_t block(std::size_t j) const noexcept { return knots_[j].block; }
  /// Index of the latest knot.
  std::size_t last() const noexcept { return knots_.end_index() - 1; }
  /// Index of the first knot that is not forgotten.
  std::size_t first() const noexcept { return knots_.begin_index(); }

  /// Forgets the knots after `last`.
  void truncate(std::size_t last);
  /// Forgets the knots before index j.
  void drop_before(std::size_t j) { knots_.drop_before(j); }

 private:
  struct Knot {
    double s;           // t_j
    std::size_t block;  // that holds it
  };

  double longest_span() const noexcept;
  double capped_by_blocks(double width, const KnownRun& run) const noexcept;
  double residual(double width, const Stretch& stretch) const noexcept;
  void schedule_growth(double residual) noexcept;

  SlidingVector<Knot> knots_;
  double tolerance_ = 0.0;
  double last_width_ = 0.0;                               // of the latest span; 0: there is none
  int spans_to_grow_ = 0;                                 // before a longer one is tried
  double cap_ = std::numeric_limits<double>::infinity();  // of spans that begin before cap_end_
  double cap_end_ = 0.0;
};

}  // namespace twin::geometry
