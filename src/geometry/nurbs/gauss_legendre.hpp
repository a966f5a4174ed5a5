#pragma once

#include <array>

/// Gauss-Legendre quadrature with five points on [-1, 1]; exact for polynomials up to degree 9.
namespace twin::geometry::gauss {

inline constexpr int kPoints = 5;
using Values = std::array<double, kPoints>;

inline constexpr Values kNodes = {-0.9061798459386639928, -0.5384693101056830910, 0.0,
                                  0.5384693101056830910, 0.9061798459386639928};
inline constexpr Values kWeights = {0.2369268850561890875, 0.4786286704993664680,
                                    0.5688888888888888889, 0.4786286704993664680,
                                    0.2369268850561890875};

/// Places at which partial integrals are to be had from the same five values: x = -1/2, 0, 1/2.
inline constexpr std::array<double, 3> kQuarters = {-0.5, 0.0, 0.5};

/// Integral from -1 to kQuarters[k] of the polynomial of degree 4 through the five values, as
/// weights of these.
inline constexpr std::array<Values, 3> kQuarterWeights = {{
    {0.2556529505053734464, 0.2771170675482416150, -0.0473611111111111111, 0.0199492977767559828,
     -0.0053582047192599331},
    {0.2275525760084492051, 0.5200093033612830372, 0.2844444444444444444, -0.0413806328619165691,
     0.0093743090477398825},
    {0.2422850897754490206, 0.4586793727226104852, 0.6162500000000000000, 0.2015116029511248531,
     -0.0187260654491843589},
}};

constexpr double weighted_sum(const Values& weights, const Values& values) noexcept {
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    sum += weights[i] * values[i];
  }
  return sum;
}

}  // namespace twin::geometry::gauss
