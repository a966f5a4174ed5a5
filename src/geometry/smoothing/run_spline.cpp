#include "geometry/smoothing/run_spline.hpp"

#include <algorithm>
#include <cmath>

namespace twin::geometry {
namespace {

constexpr double kLongestSpan = 8.0;      // H_max [mm]
constexpr double kShortestSpan = 1e-4;    // taken as it is [mm]
constexpr std::size_t kMostBlocks = 512;  // in a span
constexpr double kAhead = 4.0;            // known ahead of a knot, in spans
constexpr double kShare = 0.1;            // of the tolerance, left by the local cubics
constexpr double kLimit = 0.7;            // of the tolerance, a span's deviation
constexpr int kAttempts = 4;
constexpr std::size_t kHeldSpans = 10;
constexpr std::size_t kReach = 5;        // a span depends on knots to this many after its begin
constexpr double kMostTurn = 0.35;       // of a span [rad]
constexpr double kGrowing = 1.0 / 64.0;  // of the allowed residual; twice as long, 256 times it
constexpr int kSpansToGrow = 3;          // else, before a longer one is tried
constexpr int kFewestBlocks = 4;         // in a span whose turn can be told

}  // namespace

void RunSpline::start(const Vec3& at, double s, double tolerance) {
  polygon_.start(at, s);
  tolerance_ = tolerance;
  is_open_ = true;
  is_closed_ = is_finished_ = false;
  cap_ = std::numeric_limits<double>::infinity();
  attempts_ = 0;
  begin_at(0);
}

void RunSpline::push(const Vec3& end) {
  polygon_.push(end);
  advance();
}

void RunSpline::finish() {
  if (!is_open_) {
    return;
  }
  is_finished_ = true;
  if (!is_closed_) {
    is_closed_ = true;
    end_vertex_ = polygon_.last();
  }
  advance();
}

void RunSpline::begin_at(std::size_t vertex) {
  polygon_.forget_turn(vertex);
  begin_vertex_ = vertex;
  begin_ = polygon_[vertex].s;
  begin_at_ = polygon_[vertex].at;
  knots_.restart(0);
  knots_.push_back({begin_, vertex});
  raw_.restart(0);
  points_.restart(0);
  spans_.restart(0);
  last_width_ = 0.0;
  spans_to_grow_ = 0;
}

/// The last vertex before which all blocks are settled.
std::size_t RunSpline::last_vertex() const noexcept {
  return is_closed_ ? end_vertex_ : std::max(polygon_.last() - 1, begin_vertex_);
}

Stretch RunSpline::stretch() const noexcept {
  const std::size_t end = last_vertex();
  return {&polygon_, std::max(begin_vertex_, polygon_.first()), end - 1,
          polygon_[std::max(begin_vertex_, polygon_.first())].s, polygon_[end].s};
}

/// Everything that the points known so far decide.
void RunSpline::advance() {
  while (is_open_) {
    if (is_closed_ && end_vertex_ == begin_vertex_ + 1) {
      const Polygon::Vertex& from = polygon_[begin_vertex_];
      sink_.take_block(from.at, polygon_[end_vertex_].at, from.s, run_end());
      end_run();
    } else if (can_settle()) {
      settle();
    } else if (is_marched()) {
      give_away(spans_.end_index());
      end_run();
    } else if (can_march()) {
      march();
    } else {
      return;
    }
  }
}

void RunSpline::end_run() {
  sink_.end_run();
  if (end_vertex_ == polygon_.last()) {
    is_open_ = false;
    return;
  }
  begin_at(end_vertex_);
  is_closed_ = is_finished_;
  end_vertex_ = polygon_.last();
}

/// What the next span may have at most [mm].
double RunSpline::longest_span() const noexcept {
  const double grown = last_width_ > 0.0 ? 2.0 * last_width_ : kLongestSpan;
  const double cap = knots_.back().s < cap_end_ ? cap_ : kLongestSpan;
  return std::min({grown, cap, kLongestSpan});
}

bool RunSpline::can_march() const noexcept {
  const Knot& at = knots_.back();
  return is_closed_ || polygon_[last_vertex()].s >= at.s + kAhead * longest_span() ||
         last_vertex() - at.block > 4 * kMostBlocks;
}

/// Halves a span until it has no more than kMostBlocks blocks.
double RunSpline::capped_by_blocks(double width) const noexcept {
  const Knot& at = knots_.back();
  const std::size_t farthest = at.block + kMostBlocks;
  if (farthest < last_vertex()) {
    const double most = polygon_[farthest].s - at.s;
    while (width > most && width > kShortestSpan) {
      width *= 0.5;
    }
  }
  if (!is_closed_) {
    const double known = polygon_[last_vertex()].s - at.s;
    while (kAhead * width > known && width > kShortestSpan) {
      width *= 0.5;
    }
  }
  return width;
}

/// Mean square of what the nearest cubic leaves of the polygon around the next span, as a multiple
/// of what is allowed; infinite where the polygon turns too far.
double RunSpline::residual(double width) const noexcept {
  const Knot& at = knots_.back();
  const bool has_begin = knots_.begin_index() == 0;
  const double begin = has_begin ? at.s - width : std::max(at.s - width, knots_.front().s);
  const LocalCubic cubic(stretch(), at.block, begin, at.s + 2.0 * width);
  if (cubic.turn() > 3.0 * kMostTurn && cubic.blocks() > 3 * kFewestBlocks) {
    return std::numeric_limits<double>::infinity();
  }
  const double allowed = kShare * tolerance_;
  return cubic.mean_square() / (allowed * allowed);
}

/// The next knot. Near a known end the spans divide what is left evenly.
void RunSpline::march() {
  const double t = knots_.back().s;
  const double left = is_closed_ ? run_end() - t : std::numeric_limits<double>::infinity();
  double longest = capped_by_blocks(longest_span());
  if (longest > last_width_ && --spans_to_grow_ >= 0) {
    longest = std::max(0.5 * longest, std::min(longest, last_width_));
  }
  while (true) {
    double width = longest;
    double spans = std::numeric_limits<double>::infinity();
    if (left <= kAhead * longest) {
      spans = std::max(std::ceil(left / longest - 1e-9), last_knot() == 0 ? 2.0 : 1.0);
      width = left / spans;
    }
    const double rest = width <= kShortestSpan ? 0.0 : residual(width);
    if (rest <= 1.0) {
      if (rest <= kGrowing) {
        spans_to_grow_ = 0;
      } else if (spans_to_grow_ < 0) {
        spans_to_grow_ = kSpansToGrow;
      }
      last_width_ = width;
      add_knot(spans == 1.0 ? run_end() : t + width);
      return;
    }
    longest *= 0.5;
  }
}

void RunSpline::add_knot(double s) {
  const Stretch all = stretch();
  knots_.push_back({s, polygon_.block_at(s, knots_.back().block, all.first, all.last)});
  place_points();
}

bool RunSpline::can_settle() const noexcept {
  const std::size_t span = spans_.end_index();
  return is_marched() ? span < last_knot() : span + kReach <= last_knot();
}

/// The next span with its bound, if it keeps it.
void RunSpline::settle() {
  const std::size_t span = spans_.end_index();
  const geometry::SpanCubic cubic = cubic_of(points_, span);
  const Deviation deviation = chord_deviation(cubic, polygon_, knots_[span].block, stretch().last);
  const bool is_shortest = cubic.end - cubic.begin <= kShortestSpan;
  if (!(deviation.bound <= kLimit * tolerance_) && !is_shortest) {
    march_again(span, deviation.block);
    return;
  }
  spans_.push_back({cubic, deviation.bound});
  if (cubic.begin >= cap_end_) {
    attempts_ = 0;
  }
  if (spans_.size() > kHeldSpans) {
    give_away(spans_.begin_index() + 1);
  }
}

/// Spans up to the one before `end` come out.
void RunSpline::give_away(std::size_t end) {
  for (std::size_t i = spans_.begin_index(); i < end; ++i) {
    sink_.take_span(spans_[i].cubic, spans_[i].deviation);
  }
  spans_.drop_before(end);
  if (end > 3) {
    knots_.drop_before(end - 3);
    raw_.drop_before(end - 3);
    points_.drop_before(end - 3);
    polygon_.drop_before(knots_.front().block);
  }
}

/// A span that exceeds its limit: shorter ones, or a corner.
void RunSpline::march_again(std::size_t span, std::size_t worst_block) {
  const double width = knot(static_cast<std::ptrdiff_t>(span) + 1) - knots_[span].s;
  if (++attempts_ > kAttempts && cut(worst_block)) {
    return;
  }
  cap_ = 0.5 * (knots_[span].s < cap_end_ ? std::min(width, cap_) : width);
  cap_end_ = knots_[span].s + 2.0 * width;
  const std::size_t given = spans_.begin_index();
  const std::size_t kept = given == 0 ? 0 : given + kReach - 1;
  truncate(std::max(span > 3 ? span - 3 : 0, kept));
}

/// Forgets the knots after `last` and what they decided.
void RunSpline::truncate(std::size_t last) {
  knots_.truncate(last + 1);
  raw_.truncate(last >= 2 ? last + 1 : 0);
  points_.truncate(last >= kReach - 1 ? last - 1 : 0);
  spans_.truncate(std::max(last >= kReach ? last - kReach + 1 : 0, spans_.begin_index()));
  spans_to_grow_ = 0;
  last_width_ = last > 0 ? knots_[last].s - knots_[last - 1].s : 0.0;
}

/// Ends the run at the sharper end of a block, as far as that is not given away.
bool RunSpline::cut(std::size_t block) {
  const std::size_t given = spans_.begin_index();
  const std::size_t kept = given == 0 ? 0 : given + kReach - 1;
  const std::size_t end = last_vertex();
  const auto turn = [&](std::size_t vertex) {
    const bool is_inside = vertex > begin_vertex_ && vertex < end &&
                           polygon_[vertex].s > knots_[kept].s + kShortestSpan;
    return is_inside ? polygon_[vertex].turn : -1.0;
  };
  const std::size_t vertex = turn(block) > turn(block + 1) ? block : block + 1;
  if (turn(vertex) < 0.0) {
    return false;
  }
  attempts_ = 0;
  std::size_t last = last_knot();
  while (last > kept && knots_[last].s > polygon_[vertex].s - kShortestSpan) {
    --last;
  }
  polygon_.forget_turn(vertex);
  is_closed_ = true;
  end_vertex_ = vertex;
  const std::size_t span = spans_.end_index();
  truncate(std::max(std::min(last, span > 3 ? span - 3 : 0), kept));
  return true;
}

}  // namespace twin::geometry
