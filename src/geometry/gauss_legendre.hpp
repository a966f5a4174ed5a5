#pragma once

#include <array>
#include <cstddef>

/// Gauss-Legendre quadrature on [-1, 1]: n points are exact for polynomials up to degree 2 n - 1.
namespace twin::geometry::gauss {

/// Values of a function at the points of a rule.
template <std::size_t n>
using Values = std::array<double, n>;

/// Sum of values by their weights, from the first to the last.
template <std::size_t n>
constexpr double weighted_sum(const Values<n>& weights, const Values<n>& values) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += weights[i] * values[i];
  }
  return sum;
}

/// Points x_i in ascending order, and weights w_i, of the rule with n points:
///   integral of f from -1 to 1 = sum_i w_i f(x_i), nearly.
template <std::size_t n>
struct Rule;

template <>
struct Rule<4> {
  static constexpr Values<4> kNodes = {-0.86113631159405258, -0.33998104358485626,
                                       0.33998104358485626, 0.86113631159405258};
  static constexpr Values<4> kWeights = {0.34785484513745386, 0.65214515486254614,
                                         0.65214515486254614, 0.34785484513745386};
};

template <>
struct Rule<5> {
  static constexpr Values<5> kNodes = {-0.9061798459386639928, -0.5384693101056830910, 0.0,
                                       0.5384693101056830910, 0.9061798459386639928};
  static constexpr Values<5> kWeights = {0.2369268850561890875, 0.4786286704993664680,
                                         0.5688888888888888889, 0.4786286704993664680,
                                         0.2369268850561890875};

  /// Places to which partial integrals are known from the same five values.
  static constexpr std::array<double, 3> kQuarters = {-0.5, 0.0, 0.5};

  /// Weights of the five values for the integral from -1 to kQuarters[k] of the polynomial of
  /// degree 4 through them.
  static constexpr std::array<Values<5>, 3> kQuarterWeights = {{
      {0.2556529505053734464, 0.2771170675482416150, -0.0473611111111111111, 0.0199492977767559828,
       -0.0053582047192599331},
      {0.2275525760084492051, 0.5200093033612830372, 0.2844444444444444444, -0.0413806328619165691,
       0.0093743090477398825},
      {0.2422850897754490206, 0.4586793727226104852, 0.6162500000000000000, 0.2015116029511248531,
       -0.0187260654491843589},
  }};
};

/// Values in the opposite order.
template <std::size_t n>
constexpr Values<n> reversed(const Values<n>& values) noexcept {
  Values<n> result{};
  for (std::size_t i = 0; i < n; ++i) {
    result[i] = values[n - 1 - i];
  }
  return result;
}

/// Weights of n values at the points of the rule for the integral from -1 to x of the polynomial
/// of degree n - 1 through them: the integrals of the Lagrange polynomials.
template <std::size_t n>
constexpr Values<n> partial_weights(double x) noexcept {
  Values<n> weights{};
  for (std::size_t i = 0; i < n; ++i) {
    Values<n> c{1.0};  // coefficients of product_{k != i} (t - x_k) / (x_i - x_k)
    std::size_t degree = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i) {
        continue;
      }
      const double scale = 1.0 / (Rule<n>::kNodes[i] - Rule<n>::kNodes[k]);
      ++degree;
      for (std::size_t m = degree + 1; m-- > 0;) {
        const double lower = m > 0 ? c[m - 1] : 0.0;
        const double same = m < degree ? c[m] : 0.0;
        c[m] = scale * (lower - Rule<n>::kNodes[k] * same);
      }
    }
    double upper = x;
    double lower = -1.0;
    for (std::size_t m = 0; m < n; ++m) {
      weights[i] += c[m] / static_cast<double>(m + 1) * (upper - lower);
      upper *= x;
      lower *= -1.0;
    }
  }
  return weights;
}

}  // namespace twin::geometry::gauss
