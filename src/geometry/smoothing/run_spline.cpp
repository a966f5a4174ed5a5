#include "geometry/smoothing/run_spline.hpp"

#include <algorithm>

namespace twin::geometry {
namespace {

/// How often a place is marched again before it becomes a corner. Each time halves the spans, so
/// more attempts allow spans 1/16 as long and less. One more makes fewer corners, at which the
/// feedrate drops, and costs more spans where a corner is in the program.
constexpr int kAttempts = 4;

/// Knots before a span that are placed anew when the span fails: its control points depend on them.
constexpr std::size_t kKnotsBefore = 3;

std::size_t knots_before(std::size_t span) { return span > kKnotsBefore ? span - kKnotsBefore : 0; }

}  // namespace

void RunSpline::start(const Vec3& at, double s, double tolerance) {
  polygon_.start(at, s);
  knots_.start(tolerance);
  spans_.start(tolerance);
  state_ = State::kGrowing;
  attempts_ = 0;
  begin_at(0);
}

void RunSpline::push(const Vec3& end) {
  polygon_.push(end);
  advance();
}

void RunSpline::finish() {
  if (state_ == State::kEmpty) {
    return;
  }
  if (state_ == State::kGrowing) {
    end_vertex_ = polygon_.last();
  }
  state_ = State::kFinished;
  advance();
}

void RunSpline::begin_at(std::size_t vertex) {
  polygon_.forget_turn(vertex);
  begin_vertex_ = vertex;
  knots_.begin_at(polygon_[vertex].s, vertex);
  interpolant_.begin_at(polygon_[vertex].at);
  spans_.begin_run();
}

/// The last vertex before which all blocks are settled.
std::size_t RunSpline::last_vertex() const noexcept {
  return is_closed() ? end_vertex_ : std::max(polygon_.last() - 1, begin_vertex_);
}

KnownRun RunSpline::known() const noexcept {
  const std::size_t first = std::max(begin_vertex_, polygon_.first());
  const std::size_t end = last_vertex();
  return {{&polygon_, first, end - 1, polygon_[first].s, polygon_[end].s}, is_closed()};
}

/// Everything that the points known so far decide.
void RunSpline::advance() {
  while (state_ != State::kEmpty) {
    if (is_closed() && end_vertex_ == begin_vertex_ + 1) {
      emit_block();
      end_run();
    } else if (can_check()) {
      check_span();
    } else if (knots_.is_marched(known())) {
      spans_.release_all(sink_);
      forget_released();
      end_run();
    } else if (knots_.can_march(known())) {
      march();
    } else {
      return;
    }
  }
}

/// A run of one block stays a straight line.
void RunSpline::emit_block() {
  const Polygon::Vertex& from = polygon_[begin_vertex_];
  const Polygon::Vertex& to = polygon_[end_vertex_];
  sink_.take_block(from.at, to.at, from.s, to.s);
}

/// Goes on with the points after the run, if there are any.
void RunSpline::end_run() {
  sink_.end_run();
  if (end_vertex_ == polygon_.last()) {
    state_ = State::kEmpty;
    return;
  }
  begin_at(end_vertex_);
  if (state_ == State::kCut) {
    state_ = State::kGrowing;
  }
  end_vertex_ = polygon_.last();
}

void RunSpline::march() {
  const KnownRun run = known();
  knots_.march(run);
  interpolant_.extend(run);
}

/// Whether the next span is decided by the knots that are placed.
bool RunSpline::can_check() const noexcept {
  const std::size_t span = spans_.next();
  return knots_.is_marched(known()) ? span < knots_.last() : span + kReach <= knots_.last();
}

void RunSpline::check_span() {
  const std::size_t span = spans_.next();
  const auto worst_block =
      spans_.append(interpolant_.cubic(span), known().stretch, knots_.block(span));
  if (worst_block) {
    march_again(span, *worst_block);
    return;
  }
  if (knots_.at(span) >= knots_.shortened_until()) {
    attempts_ = 0;
  }
  if (spans_.holds_too_many()) {
    spans_.release_oldest(sink_);
    forget_released();
  }
}

/// Forgets what only the released spans need.
void RunSpline::forget_released() {
  if (spans_.released() > kKnotsBefore) {
    const std::size_t first = knots_before(spans_.released());
    knots_.drop_before(first);
    interpolant_.drop_before(first);
    polygon_.drop_before(knots_.block(knots_.first()));
  }
}

/// After a span that exceeds its limit: shorter ones, or a corner.
void RunSpline::march_again(std::size_t span, std::size_t worst_block) {
  if (++attempts_ > kAttempts && cut(worst_block)) {
    return;
  }
  knots_.shorten(span);
  truncate(std::max(knots_before(span), spans_.last_fixed_knot()));
}

/// Forgets the knots after `last_knot` and what they decided.
void RunSpline::truncate(std::size_t last_knot) {
  knots_.truncate(last_knot);
  interpolant_.truncate(last_knot);
  spans_.truncate(last_knot);
}

/// Ends the run at the sharper end of a block.
/// @returns false if both ends belong to spans that are released or lie at an end of the run
bool RunSpline::cut(std::size_t block) {
  const std::size_t fixed = spans_.last_fixed_knot();
  const std::size_t end = last_vertex();
  const auto turn = [&](std::size_t vertex) {
    const bool is_inside = vertex > begin_vertex_ && vertex < end &&
                           polygon_[vertex].s > knots_.at(fixed) + kShortestSpan;
    return is_inside ? polygon_[vertex].turn : -1.0;
  };
  const std::size_t vertex = turn(block) > turn(block + 1) ? block : block + 1;
  if (turn(vertex) < 0.0) {
    return false;
  }
  attempts_ = 0;
  std::size_t last = knots_.last();
  while (last > fixed && knots_.at(last) > polygon_[vertex].s - kShortestSpan) {
    --last;
  }
  polygon_.forget_turn(vertex);
  if (state_ == State::kGrowing) {
    state_ = State::kCut;
  }
  end_vertex_ = vertex;
  truncate(std::max(std::min(last, knots_before(spans_.next())), fixed));
  return true;
}

}  // namespace twin::geometry
