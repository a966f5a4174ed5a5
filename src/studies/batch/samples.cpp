#include "studies/batch/samples.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

namespace twin::studies::batch {
namespace {

/// Uniform numbers in [0, 1) that are the same with every standard library.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double next() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  /// A whole number below n.
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(next() * static_cast<double>(n));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimensions,
                                                 std::uint64_t seed) {
  Uniform uniform(seed);
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  std::vector<std::size_t> order(count);
  for (std::size_t k = 0; k < dimensions; ++k) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {
      std::swap(order[i - 1], order[uniform.below(i)]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      points[i][k] = (static_cast<double>(order[i]) + uniform.next()) / static_cast<double>(count);
    }
  }
  return points;
}

double normal_quantile(double p) {
  // Newton's method on the distribution, which is smooth and monotone; in the tails from the
  // asymptotic start sqrt(-2 ln p) it comes from the steep side and does not overshoot.
  if (p > 0.5) {
    return -normal_quantile(1.0 - p);
  }
  constexpr int kIterations = 60;
  double x = p < 0.1 ? -std::sqrt(-2.0 * std::log(p)) : 0.0;
  for (int i = 0; i < kIterations; ++i) {
    const double value = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double slope = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    const double step = (value - p) / slope;
    x -= step;
    if (std::abs(step) <= 1e-15 * std::abs(x)) {
      break;
    }
  }
  return x;
}

std::vector<std::vector<double>> normal_samples(std::size_t count, std::size_t dimensions,
                                                std::uint64_t seed) {
  Uniform uniform(seed);
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  for (std::vector<double>& point : points) {
    for (double& x : point) {
      const double u = uniform.next();
      x = normal_quantile(u > 0.0 ? u : 0x1p-54);
    }
  }
  return points;
}

}  // namespace twin::studies::batch
