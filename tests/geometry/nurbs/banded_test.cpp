#include "geometry/nurbs/banded.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "random_curve.hpp"

namespace twin::geometry {
namespace banded_test {

TEST(Banded, SolvesLikeADenseDecompositionWithPivots) {
  test::RandomCurves random(9);
  for (int n = 0; n < 60; ++n) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 3);
    std::vector<BandRow> rows(static_cast<std::size_t>(n));
    std::vector<Vec3> x(static_cast<std::size_t>(n));
    for (int r = 0; r < n; ++r) {
      for (int k = 0; k < 5; ++k) {
        const double element = k == 2 ? random.uniform(3, 5) : random.uniform(-1, 1);
        rows[r][k] = element;
        const int column = r + k - 2;
        if (column >= 0 && column < n) {
          dense(r, column) = element;
        }
      }
      x[r] = random.vector(10);
      right.row(r) = x[r].transpose();
    }
    solve_pentadiagonal(rows, x);
    if (n == 0) {
      continue;
    }
    const Eigen::MatrixXd expected = dense.fullPivLu().solve(right);
    for (int r = 0; r < n; ++r) {
      ASSERT_LT((x[r] - expected.row(r).transpose()).norm(), 1e-12);
    }
  }
}

}  // namespace banded_test
}  // namespace twin::geometry
