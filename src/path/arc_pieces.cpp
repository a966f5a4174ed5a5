#include "path/arc_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace twin::path {
namespace {

/// Largest distance of the pieces from the arc [mm]. It takes a thousandth of a tolerance of 10 um.
/// The number of pieces grows with its fourth root: twice the distance saves a sixth of them.
constexpr double kAccuracy = 1e-5;
constexpr int kFewestSpans = 4;
constexpr int kMostArcSpans = 4096;

/// Factor on |C''''| of a circle that covers the change of radius and the rise.
constexpr double kSlack = 2.0;

/// Largest curvature that the arc can have [1/mm].
double tightest(const Arc& arc) noexcept {
  const geometry::Arc& g = arc.geometry;
  return 1.0 / std::max(std::min(g.radius, g.radius + g.radius_change), 1e-9);
}

/// Bound of the distance of one span from the arc.
double arc_error(const Arc& arc, const geometry::SpanCubic& span, double s0) noexcept {
  const double w = span.end - span.begin;
  double largest = 0.0;
  for (const double s : {span.begin, span.end}) {
    const PathPoint at = point_at(arc, s - s0);
    const double t = s - span.begin;
    const Vec3 offset = span.position(s) - at.position;
    const Vec3 slope = span.c1 + t * (2.0 * span.c2 + (3.0 * t) * span.c3) - at.tangent;
    largest = std::max(largest, offset.norm() + w / 3.0 * slope.norm());
  }
  const double k = tightest(arc);
  return largest + kSlack * k * k * k * w * w * w * w / 384.0;
}

/// Twice the largest distance of one span from the curve that is seen at places in it.
double curve_error(const FittedCurve& curve, const geometry::SpanCubic& span, double s0) {
  double largest = 0.0;
  for (const double part : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    const double s = span.begin + part * (span.end - span.begin);
    largest = std::max(largest, (span.position(s) - point_at(curve, s - s0).position).norm());
  }
  return 2.0 * largest;
}

/// Control points on equal spans, and the pieces they make.
/// @param place_at  place at a length of the path
/// @param error_of  bound of the distance of one span from it
template <class PlaceAt, class ErrorOf>
double append(const PlaceAt& place_at, const ErrorOf& error_of, double from, double to, double s0,
              int spans, std::vector<geometry::SpanCubic>& pieces) {
  const double w = (to - from) / spans;
  const auto t = [&](int j) { return std::clamp(j, 0, spans) * w; };
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(spans) + 3);
  const auto blossom = [&](const PathPoint& at, double centre, int j) {
    const double a = t(j + 1) - centre;
    const double b = t(j + 2) - centre;
    const double c = t(j + 3) - centre;
    return Vec3(at.position + ((a + b + c) / 3.0) * at.tangent +
                ((a * b + b * c + c * a) / 6.0) * at.curvature);
  };
  const PathPoint begin = place_at(from);
  const PathPoint end = place_at(to);
  for (int j = -3; j < spans; ++j) {
    if (j < 0) {
      points.push_back(blossom(begin, 0.0, j));
    } else if (j >= spans - 3) {
      points.push_back(blossom(end, t(spans), j));
    } else {
      points.push_back(blossom(place_at(from + t(j + 2)), t(j + 2), j));
    }
  }
  double error = 0.0;
  for (int span = 0; span < spans; ++span) {
    std::array<double, 6> u{};
    for (int k = 0; k < 6; ++k) {
      u[static_cast<std::size_t>(k)] = s0 + from + t(span + k - 2);
    }
    pieces.push_back(geometry::span_cubic(
        geometry::SpanView{&u[2], &points[static_cast<std::size_t>(span)], nullptr}));
    error = std::max(error, error_of(pieces.back()));
  }
  return error;
}

/// Pieces close enough: doubles the spans, up to kMostArcSpans.
template <class PlaceAt, class ErrorOf>
double append_close(const PlaceAt& place_at, const ErrorOf& error_of, double from, double to,
                    double s0, int spans, std::vector<geometry::SpanCubic>& pieces) {
  const std::size_t first = pieces.size();
  while (true) {
    const double error = append(place_at, error_of, from, to, s0, spans, pieces);
    if (error <= kAccuracy || 2 * spans > kMostArcSpans) {
      return error;
    }
    pieces.resize(first);
    spans *= 2;
  }
}

}  // namespace

double append_arc_pieces(const Arc& arc, double from, double to, double s0,
                         std::vector<geometry::SpanCubic>& pieces) {
  const double k = tightest(arc);
  const double guess = (to - from) * std::pow(0.05 * k * k * k / kAccuracy, 0.25);
  int spans =
      static_cast<int>(std::clamp(std::ceil(guess), 1.0 * kFewestSpans, 1.0 * kMostArcSpans));
  spans += spans % 2;
  return append_close([&](double s) { return point_at(arc, s); },
                      [&](const geometry::SpanCubic& span) { return arc_error(arc, span, s0); },
                      from, to, s0, spans, pieces);
}

double append_curve_pieces(const FittedCurve& curve, double from, double to, double s0,
                           std::vector<geometry::SpanCubic>& pieces) {
  return append_close([&](double s) { return point_at(curve, s); },
                      [&](const geometry::SpanCubic& span) { return curve_error(curve, span, s0); },
                      from, to, s0, kFewestSpans, pieces);
}

}  // namespace twin::path
