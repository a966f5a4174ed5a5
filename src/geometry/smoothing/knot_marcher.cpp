#include "geometry/smoothing/knot_marcher.hpp"

#include <algorithm>
#include <cmath>

namespace twin::geometry {
namespace {

/// H_max, the longest span [mm]. Twice as long, a smooth run has up to half the spans, but a point
/// of the program waits for twice the length of program behind it.
constexpr double kLongestSpan = 8.0;

/// Most blocks in a span. It bounds the work for one knot; twice as many double that bound.
constexpr std::size_t kMostBlocks = 512;

/// How far ahead of a knot the run must be known, in longest possible spans. The window needs 2;
/// the rest lets the spans near the end of the run be divided evenly. More delays the spline.
constexpr double kAhead = 4.0;

/// Share of the tolerance that the local cubics may leave (root mean square). The spline itself
/// lies farther off than they do. Twice the share makes spans longer by 2^(1/4), for the error
/// grows with the fourth power of the length, but more spans exceed their limit and are marched
/// again.
constexpr double kShare = 0.1;

/// Largest turn of a span [rad]. The curvature of a spline is right to a twelfth of its square, 1
/// %. Twice the turn makes that 4 %, and the feedrate limits are computed from the curvature.
constexpr double kMostTurn = 0.35;

/// Mean square residual, as a share of the allowed one, below which a longer span is tried next.
/// Twice the length has up to 256 times the mean square. At 1/256 no trial would fail; here some do
/// and cost one more cubic each, but spans grow sooner. Twice the share fails more often.
constexpr double kGrowing = 1.0 / 64.0;

/// Spans before a longer one is tried although the residual speaks against it. Fewer cost cubics
/// that fail; more leave spans short behind a tight place.
constexpr int kSpansToGrow = 3;

/// Fewest blocks in a span whose turn can be told: the corners between fewer blocks are no round.
constexpr int kFewestBlocks = 4;

}  // namespace

void KnotMarcher::start(double tolerance) noexcept {
  tolerance_ = tolerance;
  cap_ = std::numeric_limits<double>::infinity();
}

void KnotMarcher::begin_at(double s, std::size_t block) {
  knots_.restart(0);
  knots_.push_back({s, block});
  last_width_ = 0.0;
  spans_to_grow_ = 0;
  kept_.fill({});
}

double KnotMarcher::reflected(std::ptrdiff_t j) const noexcept {
  if (j < 0) {
    return 2.0 * knots_[0].s - knots_[static_cast<std::size_t>(-j)].s;
  }
  const auto last_knot = static_cast<std::ptrdiff_t>(last());
  return j <= last_knot
             ? knots_[static_cast<std::size_t>(j)].s
             : 2.0 * knots_.back().s - knots_[static_cast<std::size_t>(2 * last_knot - j)].s;
}

/// What the next span may have at most [mm].
double KnotMarcher::longest_span() const noexcept {
  const double grown = last_width_ > 0.0 ? 2.0 * last_width_ : kLongestSpan;
  const double cap = knots_.back().s < cap_end_ ? cap_ : kLongestSpan;
  return std::min({grown, cap, kLongestSpan});
}

bool KnotMarcher::can_march(const KnownRun& run) const noexcept {
  const Knot& at = knots_.back();
  return run.is_closed || run.stretch.end >= at.s + kAhead * longest_span() ||
         run.stretch.last + 1 - at.block > 4 * kMostBlocks;
}

/// Halves a span until it has no more than kMostBlocks blocks.
double KnotMarcher::capped_by_blocks(double width, const KnownRun& run) const noexcept {
  const Knot& at = knots_.back();
  const std::size_t farthest = at.block + kMostBlocks;
  if (farthest < run.stretch.last + 1) {
    const double most = (*run.stretch.polygon)[farthest].s - at.s;
    while (width > most && width > kShortestSpan) {
      width *= 0.5;
    }
  }
  if (!run.is_closed) {
    const double known = run.stretch.end - at.s;
    while (kAhead * width > known && width > kShortestSpan) {
      width *= 0.5;
    }
  }
  return width;
}

PathMoments KnotMarcher::moments(const Stretch& stretch, std::size_t block, double begin,
                                 double end) noexcept {
  for (const PathMoments& kept : kept_) {
    if (kept.begin() == begin && kept.end() == end) {
      return kept;
    }
  }
  const PathMoments moments(stretch, block, begin, end);
  if (begin >= stretch.begin &&
      end <= stretch.end) {  // what is mirrored changes when more is known
    kept_[next_kept_] = moments;
    next_kept_ = (next_kept_ + 1) % kKept;
  }
  return moments;
}

/// Mean square of what the nearest cubic leaves of the polygon around the next span, as a multiple
/// of what is allowed; infinite where the polygon turns too far.
double KnotMarcher::residual(double width, const Stretch& stretch) noexcept {
  const Knot& at = knots_.back();
  const bool has_begin = knots_.begin_index() == 0;
  double begin = has_begin ? at.s - width : std::max(at.s - width, knots_.front().s);
  std::size_t block = at.block;
  if (width == last_width_) {  // the span before the knot
    begin = knots_[last() - 1].s;
    block = knots_[last() - 1].block;
  }
  const double middle = at.s + width;
  const std::array<PathMoments, 3> parts{moments(stretch, block, begin, at.s),
                                         moments(stretch, at.block, at.s, middle),
                                         moments(stretch, at.block, middle, middle + width)};
  const LocalCubic cubic(begin < at.s ? std::span(parts) : std::span(parts).subspan(1));
  if (cubic.turn() > 3.0 * kMostTurn && cubic.blocks() > 3 * kFewestBlocks) {
    return std::numeric_limits<double>::infinity();
  }
  const double allowed = kShare * tolerance_;
  return cubic.mean_square() / (allowed * allowed);
}

/// After a span that fits: when a longer one is tried.
void KnotMarcher::schedule_growth(double residual) noexcept {
  if (residual <= kGrowing) {
    spans_to_grow_ = 0;
  } else if (spans_to_grow_ < 0) {
    spans_to_grow_ = kSpansToGrow;
  }
}

void KnotMarcher::march(const KnownRun& run) {
  const double t = knots_.back().s;
  const double left = run.is_closed ? run.stretch.end - t : std::numeric_limits<double>::infinity();
  double longest = capped_by_blocks(longest_span(), run);
  if (longest > last_width_ && --spans_to_grow_ >= 0) {
    longest = std::max(0.5 * longest, std::min(longest, last_width_));
  }
  double width = 0.0;
  double spans = 0.0;  // that divide what is left; infinite: it is not divided yet
  while (true) {       // halves, so it ends at the shortest span at the latest
    width = longest;
    spans = std::numeric_limits<double>::infinity();
    if (left <= kAhead * longest) {
      spans = std::max(std::ceil(left / longest - 1e-9), last() == 0 ? 2.0 : 1.0);
      width = left / spans;
    }
    const double rest = width > kShortestSpan ? residual(width, run.stretch) : 0.0;
    if (rest <= 1.0) {
      schedule_growth(rest);
      break;
    }
    longest *= 0.5;
  }
  last_width_ = width;
  const double s = spans == 1.0 ? run.stretch.end : t + width;
  knots_.push_back({s, run.stretch.polygon->block_at(s, knots_.back().block, run.stretch.first,
                                                     run.stretch.last)});
}

void KnotMarcher::shorten(std::size_t span) noexcept {
  const double begin = knots_[span].s;
  const double width = reflected(static_cast<std::ptrdiff_t>(span) + 1) - begin;
  cap_ = 0.5 * (begin < cap_end_ ? std::min(width, cap_) : width);
  cap_end_ = begin + 2.0 * width;
}

void KnotMarcher::truncate(std::size_t last) {
  knots_.truncate(last + 1);
  spans_to_grow_ = 0;
  kept_.fill({});  // the path changes where a run is cut
  last_width_ = last > 0 ? knots_[last].s - knots_[last - 1].s : 0.0;
}

}  // namespace twin::geometry
