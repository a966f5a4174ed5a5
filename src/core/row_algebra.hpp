#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

/// Linear algebra of a few rows of numbers, as plain loops: Eigen's decompositions of matrices of
/// fixed size take ten times as long to compile.
namespace twin {

template <std::size_t n>
using SquareMatrix = std::array<std::array<double, n>, n>;

/// The scalar product; of the longer one the first coordinates count.
template <std::size_t n, std::size_t m>
double product(const std::array<double, n>& a, const std::array<double, m>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(n, m); ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// Adds a multiple of b to a.
template <std::size_t n, std::size_t m>
void add_to(std::array<double, n>& a, double factor, const std::array<double, m>& b) {
  for (std::size_t i = 0; i < std::min(n, m); ++i) {
    a[i] += factor * b[i];
  }
}

/// Takes the part of a row that lies along the first `count` of some orthonormal rows out of it,
/// twice, so that rounding leaves nothing of it.
template <std::size_t n, std::size_t m>
void make_orthogonal(std::array<double, n>& row, const std::array<std::array<double, n>, m>& to,
                     std::size_t count) {
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < count; ++i) {
      add_to(row, -product(row, to[i]), to[i]);
    }
  }
}

/// Solves a x = b in the first `count` coordinates, by a Cholesky decomposition that overwrites a.
///
/// @param a  symmetric; of it the lower triangle is read
/// @returns whether a is positive definite
template <std::size_t n>
bool solve_in_place(SquareMatrix<n>& a, std::array<double, n>& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= a[i][k] * a[j][k];
      }
      if (i == j && !(sum > 0.0)) {
        return false;
      }
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      b[i] -= a[i][k] * b[k];
    }
    b[i] /= a[i][i];
  }
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t k = i + 1; k < count; ++k) {
      b[i] -= a[k][i] * b[k];
    }
    b[i] /= a[i][i];
  }
  return true;
}

}  // namespace twin
