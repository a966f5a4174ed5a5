#include "tests/fuzz/chain/shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace twin::fuzz {
namespace {

constexpr double kArcSlack = 5e-5;      // of the polyline of an arc [mm]
constexpr double kReadRounding = 1e-5;  // of centre and end of an arc in the text [mm]
constexpr int kSamplesOfSpan = 24;

/// N_(i,p)(u) = (u - u_i) / (u_(i+p) - u_i) N_(i,p-1) + (u_(i+p+1) - u) / (u_(i+p+1) - u_(i+1)) N_(i+1,p-1)
double basis(const std::vector<double>& knots, std::size_t i, std::size_t p, double u) {
  if (p == 0) {
    // The end of the last span belongs to it.
    const bool is_end = u == knots.back() && knots[i + 1] == u && knots[i] < u;
    return (knots[i] <= u && u < knots[i + 1]) || is_end ? 1.0 : 0.0;
  }
  const double before = knots[i + p] - knots[i];
  const double after = knots[i + p + 1] - knots[i + 1];
  return (before > 0.0 ? (u - knots[i]) / before * basis(knots, i, p - 1, u) : 0.0) +
         (after > 0.0 ? (knots[i + p + 1] - u) / after * basis(knots, i + 1, p - 1, u) : 0.0);
}

Vec3 point_at(const NurbsOutline& nurbs, std::size_t span, double u) {
  Vec3 sum = Vec3::Zero();
  double weights = 0.0;
  for (std::size_t i = span - nurbs.degree; i <= span; ++i) {  // all others are 0 here
    const double part = nurbs.weights[i] * basis(nurbs.knots, i, nurbs.degree, u);
    sum += part * nurbs.points[i];
    weights += part;
  }
  return sum / weights;
}

/// Radius of the circle through three points [mm].
double radius_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double area = (b - a).cross(c - a).norm();
  const double product = (b - a).norm() * (c - b).norm() * (c - a).norm();
  return area > 1e-9 * product ? 0.5 * product / area : std::numeric_limits<double>::infinity();
}

}  // namespace

Shape line_shape(const Vec3& from, const Vec3& to) {
  return {{from, to}, 0.0, std::numeric_limits<double>::infinity()};
}

Shape arc_shape(const ArcOutline& arc) {
  const auto in_plane = [&](const Vec3& v) { return Vec2(v[arc.first], v[arc.second]); };
  const Vec2 from = in_plane(arc.start - arc.centre);
  const Vec2 to = in_plane(arc.end - arc.centre);
  const double sense = arc.is_clockwise ? -1.0 : 1.0;
  const double begin = std::atan2(from.y(), from.x());
  double sweep = sense * (std::atan2(to.y(), to.x()) - begin);
  sweep -= 2.0 * std::numbers::pi * std::floor(sweep / (2.0 * std::numbers::pi));
  if (arc.is_full) {
    sweep = 2.0 * std::numbers::pi;
  }
  const double step = 2.0 * std::acos(std::max(1.0 - kArcSlack / from.norm(), 0.5));
  const int count = std::clamp(static_cast<int>(sweep / step) + 1, 8, 4000);
  Shape shape{{}, kArcSlack + kReadRounding, std::min(from.norm(), to.norm())};
  for (int i = 0; i <= count; ++i) {
    const double f = static_cast<double>(i) / count;
    const double angle = begin + sense * f * sweep;
    const double radius = from.norm() + f * (to.norm() - from.norm());
    Vec3 point = arc.start + f * (arc.end - arc.start);  // its third axis
    point[arc.first] = arc.centre[arc.first] + radius * std::cos(angle);
    point[arc.second] = arc.centre[arc.second] + radius * std::sin(angle);
    shape.points.push_back(point);
  }
  shape.points.front() = arc.start;
  shape.points.back() = arc.end;
  return shape;
}

Shape nurbs_shape(const NurbsOutline& nurbs) {
  Shape shape{{nurbs.points.front()}, 0.0, std::numeric_limits<double>::infinity()};
  for (std::size_t span = nurbs.degree; span < nurbs.points.size(); ++span) {
    const double from = nurbs.knots[span];
    const double width = nurbs.knots[span + 1] - from;
    for (int i = 1; i <= kSamplesOfSpan && width > 0.0; ++i) {
      const Vec3 last = shape.points.back();
      const double u =
          i == kSamplesOfSpan ? nurbs.knots[span + 1] : from + width * i / kSamplesOfSpan;
      const Vec3 middle = point_at(nurbs, span, u - 0.5 * width / kSamplesOfSpan);
      const Vec3 next =
          point_at(nurbs, span, std::min(u, std::nextafter(nurbs.knots[span + 1], from)));
      const Vec3 off = middle - last;
      const Vec3 way = next - last;
      const double along = way.squaredNorm() > 0.0 ? off.dot(way) / way.squaredNorm() : 0.0;
      shape.slack = std::max(shape.slack, 2.0 * (off - along * way).norm());
      shape.radius = std::min(shape.radius, 0.5 * radius_of(last, middle, next));
      shape.points.push_back(next);
    }
  }
  shape.points.back() = nurbs.points.back();
  shape.slack += kReadRounding;
  return shape;
}

double length_of(const std::vector<Vec3>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length += (points[i] - points[i - 1]).norm();
  }
  return length;
}

Vec3 directions_of(const std::vector<Vec3>& points) {
  Vec3 largest = Vec3::Zero();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3 way = points[i] - points[i - 1];
    if (way.norm() > 0.0) {
      largest = largest.cwiseMax((way / way.norm()).cwiseAbs());
    }
  }
  return largest;
}

}  // namespace twin::fuzz
