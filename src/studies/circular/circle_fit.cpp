#include "studies/circular/circle_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/linear_algebra.hpp"

namespace twin::studies::circular {
namespace {

constexpr int kMostIterations = 50;
constexpr double kSmallStep = 1e-12;       // of a centre or radius, where the iteration ends [mm]
constexpr double kGoldenPrecision = 1e-6;  // of the interval searched

/// A point seen from the least-squares centre.
struct Ray {
  double cosine = 0.0;
  double sine = 0.0;
  double radius = 0.0;  // [mm]
};

double separation(const std::vector<Ray>& rays, double dx, double dy) {
  double least = std::numeric_limits<double>::infinity();
  double largest = -least;
  for (const Ray& ray : rays) {
    const double radius = ray.radius - dx * ray.cosine - dy * ray.sine;
    least = std::min(least, radius);
    largest = std::max(largest, radius);
  }
  return largest - least;
}

struct Minimum {
  double at = 0.0;
  double value = 0.0;
};

/// Minimum of a convex function over [-reach, reach].
template <class Function>
Minimum golden_section(double reach, const Function& function) {
  const double share = (std::sqrt(5.0) - 1.0) / 2.0;
  double low = -reach;
  double high = reach;
  double left = high - share * (high - low);
  double right = low + share * (high - low);
  double at_left = function(left);
  double at_right = function(right);
  while (high - low > 2.0 * kGoldenPrecision * reach) {
    if (at_left <= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - share * (high - low);
      at_left = function(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + share * (high - low);
      at_right = function(right);
    }
  }
  return at_left <= at_right ? Minimum{left, at_left} : Minimum{right, at_right};
}

}  // namespace

Circle least_squares_circle(std::span<const Vec2> points) {
  Circle circle;
  for (const Vec2& point : points) {
    circle.centre += point / static_cast<double>(points.size());
  }
  for (const Vec2& point : points) {
    circle.radius += (point - circle.centre).norm() / static_cast<double>(points.size());
  }
  for (int i = 0; i < kMostIterations; ++i) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Vec2& point : points) {
      const Vec2 arm = point - circle.centre;
      const double length = arm.norm();
      if (length > 0.0) {
        const Eigen::Vector3d slope(arm.x() / length, arm.y() / length, 1.0);
        normal += slope * slope.transpose();
        right += slope * (length - circle.radius);
      }
    }
    const Eigen::Vector3d step = solve_symmetric(normal, right);
    circle.centre += step.head<2>();
    circle.radius += step[2];
    if (step.norm() < kSmallStep) {
      break;
    }
  }
  return circle;
}

MinimumZone minimum_zone(std::span<const Vec2> points) {
  const Vec2 centre = least_squares_circle(points).centre;
  std::vector<Ray> rays;
  rays.reserve(points.size());
  for (const Vec2& point : points) {
    const Vec2 arm = point - centre;
    const double radius = arm.norm();
    rays.push_back({arm.x() / radius, arm.y() / radius, radius});
  }
  // A centre further off than this has a wider zone than d = 0.
  const double reach = separation(rays, 0.0, 0.0);
  MinimumZone zone{centre, reach};
  if (!(reach > 0.0)) {
    return zone;
  }
  const auto best_dy = [&](double dx) {
    return golden_section(reach, [&](double dy) { return separation(rays, dx, dy); });
  };
  const Minimum x = golden_section(reach, [&](double dx) { return best_dy(dx).value; });
  if (x.value < reach) {
    zone = {centre + Vec2(x.at, best_dy(x.at).at), x.value};
  }
  return zone;
}

}  // namespace twin::studies::circular
