#include "geometry/smoothing/span_checker.hpp"

#include <algorithm>

#include "geometry/smoothing/chord_deviation.hpp"

namespace twin::geometry {
namespace {

/// Share of the tolerance that a span may deviate. The rest is left to the bumps that join the run
/// to its neighbours: a larger share gives longer spans, and narrower, slower corners.
constexpr double kLimit = 0.7;

/// Spans that are held back. A span that fails moves the knots of the few before it, and a corner
/// ends the run there. With fewer, some of those spans would be fixed already, and corners would
/// lie farther from the sharpest vertex; with more, the spline comes later.
constexpr std::size_t kHeldSpans = 10;

}  // namespace

std::optional<std::size_t> SpanChecker::append(const SpanCubic& cubic, const Stretch& stretch,
                                               std::size_t block) {
  const Deviation deviation = chord_deviation(cubic, *stretch.polygon, block, stretch.last);
  const bool is_shortest = cubic.end - cubic.begin <= kShortestSpan;
  if (!(deviation.bound <= kLimit * tolerance_) && !is_shortest) {
    return deviation.block;
  }
  spans_.push_back({cubic, deviation.bound});
  return std::nullopt;
}

bool SpanChecker::holds_too_many() const noexcept { return spans_.size() > kHeldSpans; }

void SpanChecker::release(std::size_t end, RunSink& sink) {
  for (std::size_t i = spans_.begin_index(); i < end; ++i) {
    sink.take_span(spans_[i].cubic, spans_[i].deviation);
  }
  spans_.drop_before(end);
}

void SpanChecker::truncate(std::size_t last) {
  spans_.truncate(std::max(last >= kReach ? last - kReach + 1 : 0, spans_.begin_index()));
}

}  // namespace twin::geometry
