#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "geometry/nurbs/curve.hpp"

namespace twin::test {

/// Curves and parameters from a fixed seed.
class RandomCurves {
 public:
  explicit RandomCurves(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }

  /// Non-periodic knots on [-1, 2] for count control points; inner knots repeated now and then,
  /// never p times.
  std::vector<double> knots(int degree, int count) {
    std::vector<double> inner;
    while (static_cast<int>(inner.size()) < count - degree - 1) {
      const bool again = !inner.empty() && uniform(0, 1) < 0.15 &&
                         std::count(inner.begin(), inner.end(), inner.back()) + 1 < degree;
      inner.push_back(again ? inner.back() : uniform(-0.9, 1.9));
    }
    std::sort(inner.begin(), inner.end());
    inner.insert(inner.begin(), static_cast<std::size_t>(degree) + 1, -1.0);
    inner.insert(inner.end(), static_cast<std::size_t>(degree) + 1, 2.0);
    return inner;
  }

  geometry::Curve curve(int degree, int count, bool rational) {
    std::vector<Vec3> points;
    std::vector<double> weights;
    for (int i = 0; i < count; ++i) {
      points.push_back(vector(10.0));
      if (rational) {
        weights.push_back(uniform(0.3, 3.0));
      }
    }
    return *geometry::Curve::create(degree, knots(degree, count), std::move(points),
                                    std::move(weights));
  }

 private:
  std::mt19937 random_;
};

}  // namespace twin::test
