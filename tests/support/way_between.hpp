#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "core/vec.hpp"

/// What set points alone tell of the way between them.
namespace twin::test {

/// Lengths of the way between four points in order [mm].
using Lengths = std::array<double, 3>;

/// Lengths between points that lie on one straight line, in order; nothing if they do not.
/// @param off  distance from the line that counts as none [mm]
inline std::optional<Lengths> lengths_on_line(std::span<const Vec3, 4> p, double off) {
  const Vec3 way = p.back() - p.front();
  const double total = way.norm();
  Lengths lengths{};
  for (std::size_t i = 1; i < p.size(); ++i) {
    const Vec3 from_start = p[i] - p.front();
    const double along = total > 0.0 ? from_start.dot(way) / total : 0.0;
    const Vec3 aside = total > 0.0 ? Vec3(from_start - along / total * way) : from_start;
    const Vec3 step = p[i] - p[i - 1];
    if (aside.norm() > off || step.dot(way) < 0.0) {
      return std::nullopt;
    }
    lengths[i - 1] = step.norm();
  }
  return lengths;
}

/// The same of the inner four of six points on one circle: the circle through the first, a middle
/// and the last of them. Nothing where two of the points are one, since there is a circle through
/// any three, and where neither the point before nor the one after is on the circle as well: now
/// and then four points beside a corner are on one.
inline std::optional<Lengths> lengths_on_circle(std::span<const Vec3, 6> around, double off) {
  const std::span<const Vec3, 4> p = around.subspan<1, 4>();
  const Vec3 a = p[p.size() / 2] - p.front();
  const Vec3 b = p.back() - p.front();
  const Vec3 normal = a.cross(b);
  const double n2 = normal.squaredNorm();
  if (n2 <= 0.0) {
    return std::nullopt;
  }
  const Vec3 to_centre =
      (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) / (2.0 * n2);
  const double radius = to_centre.norm();
  const Vec3 centre = p.front() + to_centre;
  const Vec3 axis = normal / std::sqrt(n2);
  const auto distance = [&](const Vec3& point) {
    const Vec3 from_centre = point - centre;
    const double height = from_centre.dot(axis);
    return std::hypot((from_centre - height * axis).norm() - radius, height);
  };
  const auto is_fifth = [&](const Vec3& point, const Vec3& neighbour) {
    return distance(point) <= off && (point - neighbour).norm() > off;
  };
  if (!is_fifth(around[0], around[1]) && !is_fifth(around[5], around[4])) {
    return std::nullopt;
  }
  Lengths lengths{};
  for (std::size_t i = 1; i < p.size(); ++i) {
    const Vec3 from_centre = p[i] - centre;
    const bool is_ahead = (p[i - 1] - centre).cross(from_centre).dot(axis) >= 0.0;
    const double chord = (p[i] - p[i - 1]).norm();
    if (distance(p[i]) > off || !is_ahead || chord > radius || chord <= off) {
      return std::nullopt;
    }
    lengths[i - 1] = 2.0 * radius * std::asin(0.5 * chord / radius);
  }
  return lengths;
}

/// Lengths between four points on one line or circle. Nothing where they are on neither, as beside
/// a joint, and where the path turns back next to them, for nobody can tell how far it went there.
///
/// @param around  the four points, with the one before and the one after them
inline std::optional<Lengths> lengths_between(std::span<const Vec3, 6> around, double off) {
  const auto turns_back = [&](std::size_t i) {
    return (around[i] - around[i - 1]).dot(around[i + 1] - around[i]) < 0.0;
  };
  if (turns_back(1) || turns_back(4)) {
    return std::nullopt;
  }
  const std::span<const Vec3, 4> window = around.subspan<1, 4>();
  const auto on_line = lengths_on_line(window, off);
  if (on_line || turns_back(2) || turns_back(3)) {
    return on_line;
  }
  return lengths_on_circle(around, off);
}

/// Curvature of the circle through three points times the square of the feedrate [mm/s^2].
/// @param period  time from point to point [s]
inline double normal_acceleration(const Vec3& a, const Vec3& b, const Vec3& c, double period) {
  const double span = (c - a).norm();
  return span > 0.0 ? 2.0 * (b - a).cross(c - b).norm() / span / (period * period) : 0.0;
}

}  // namespace twin::test
