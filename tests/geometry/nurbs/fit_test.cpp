#include "geometry/nurbs/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "naive.hpp"
#include "random_curve.hpp"

namespace twin::geometry {
namespace fit_test {

/// A random walk of n+1 points with chords of `smallest` to 1 mm and turns up to 60 deg or so.
std::vector<Vec3> random_run(test::RandomCurves& random, int n, double smallest = 0.05) {
  std::vector<Vec3> points = {random.vector(20.0)};
  Vec3 direction = random.vector(1.0).normalized();
  for (int i = 0; i < n; ++i) {
    direction = (direction + random.vector(0.4)).normalized();
    points.emplace_back(points.back() +
                        std::exp(random.uniform(std::log(smallest), 0)) * direction);
  }
  return points;
}

EndCondition random_condition(test::RandomCurves& random, bool clamped) {
  return {clamped, random.vector(1.0), random.vector(1.0)};
}

TEST(Fit, PassesThroughAllPointsAtTheirChordLengths) {
  test::RandomCurves random(20);
  Fitter fitter;
  Curve curve;
  for (int round = 0; round < 1000; ++round) {
    const auto begin = random_condition(random, round % 2 == 0);
    const auto end = random_condition(random, round % 4 < 2);
    const int least = begin.clamped || end.clamped ? 1 : 3;
    const auto points = random_run(random, least + round % 21);
    ASSERT_EQ(fitter.fit(points, begin, end, curve), FitResult::kFitted);
    const auto& l = fitter.parameters();
    ASSERT_EQ(l.size(), points.size());
    ASSERT_EQ(curve.u_min(), 0.0);
    ASSERT_EQ(curve.u_max(), l.back());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_LT((curve.position(l[i]) - points[i]).norm(), 1e-12);
      if (i > 0) {
        ASSERT_NEAR(l[i] - l[i - 1], (points[i] - points[i - 1]).norm(), 1e-13);
      }
    }
  }
}

TEST(Fit, HasTheDerivativesPrescribedAtClampedEnds) {
  test::RandomCurves random(21);
  Fitter fitter;
  Curve curve;
  for (int round = 0; round < 300; ++round) {
    const auto begin = random_condition(random, true);
    const auto end = random_condition(random, true);
    ASSERT_EQ(fitter.fit(random_run(random, 1 + round % 20), begin, end, curve),
              FitResult::kFitted);
    const Derivatives first = curve.derivatives(curve.u_min());
    const Derivatives last = curve.derivatives(curve.u_max());
    ASSERT_LT((first.first - begin.first).norm(), 1e-11);
    ASSERT_LT((first.second - begin.second).norm(), 1e-9);
    ASSERT_LT((last.first - end.first).norm(), 1e-11);
    ASSERT_LT((last.second - end.second).norm(), 1e-9);
  }
}

TEST(Fit, HasTheControlPointsOfADenseSolutionWithPivots) {
  test::RandomCurves random(22);
  Fitter fitter;
  Curve curve;
  for (int n = 3; n < 40; ++n) {
    const auto points = random_run(random, n);
    ASSERT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
    Eigen::MatrixXd matrix(n + 1, n + 1);
    Eigen::MatrixXd right(n + 1, 3);
    for (int r = 0; r <= n; ++r) {
      right.row(r) = points[r].transpose();
      for (int i = 0; i <= n; ++i) {
        matrix(r, i) = test::naive_basis(curve.knots(), i, 3, fitter.parameters()[r]);
      }
    }
    const Eigen::MatrixXd expected = test::solve_with_pivots(matrix, right);
    for (int i = 0; i <= n; ++i) {
      ASSERT_LT((curve.control_points()[i] - expected.row(i).transpose()).norm(), 1e-11);
    }
  }
}

TEST(Fit, ReproducesACubicPolynomialOfItsParameter) {
  // The graph of a polynomial so flat that chord length is x, to 1e-12.
  constexpr double kFlat = 1e-6;
  const auto y = [](double x) { return kFlat * (1 + x * (-2 + x * (0.7 - 0.4 * x))); };
  const auto slope = [](double x) { return kFlat * (-2 + x * (1.4 - 1.2 * x)); };
  const auto bend = [](double x) { return kFlat * (1.4 - 2.4 * x); };
  const auto condition = [&](double x) {
    return EndCondition{true, {1, slope(x), 0}, {0, bend(x), 0}};
  };
  std::vector<Vec3> points;
  for (const double x : {0.0, 0.2, 0.3, 0.45, 0.9, 1.0, 1.3, 1.35, 1.9}) {
    points.emplace_back(x, y(x), 0.0);
  }
  Fitter fitter;
  Curve curve;
  for (const EndCondition& begin : {EndCondition{}, condition(0.0)}) {
    for (const EndCondition& end : {EndCondition{}, condition(1.9)}) {
      ASSERT_EQ(fitter.fit(points, begin, end, curve), FitResult::kFitted);
      for (double u = 0.0; u <= curve.u_max(); u += 0.01) {
        const Derivatives at = curve.derivatives(u);
        ASSERT_NEAR(at.position.x(), u, 1e-10);
        ASSERT_NEAR(at.position.y(), y(u), 1e-9 * kFlat);
        ASSERT_NEAR(at.first.y(), slope(u), 1e-8 * kFlat);
        ASSERT_NEAR(at.second.y(), bend(u), 1e-6 * kFlat);
      }
    }
  }
}

TEST(Fit, OfCollinearPointsIsTheStraightLine) {
  Fitter fitter;
  Curve curve;
  const Vec3 direction = Vec3(2, -3, 1).normalized();
  std::vector<Vec3> points;
  for (const double l : {0.0, 0.1, 0.15, 1.0, 1.01, 2.5, 2.6, 4.0}) {
    points.emplace_back(Vec3(5, 6, 7) + l * direction);
  }
  const EndCondition ahead{true, direction, Vec3::Zero()};
  for (const auto& [begin, end] :
       {std::pair{EndCondition{}, EndCondition{}}, {ahead, EndCondition{}}, {ahead, ahead}}) {
    ASSERT_EQ(fitter.fit(points, begin, end, curve), FitResult::kFitted);
    for (int i = 0; i <= 1000; ++i) {
      const double u = 0.001 * i * curve.u_max();
      const Derivatives at = curve.derivatives(u);
      ASSERT_LT((at.position - (points[0] + u * direction)).norm(), 1e-12);
      ASSERT_LT((at.first - direction).norm(), 1e-11);
    }
  }
}

TEST(Fit, OfPointsOnAnAxisStaysOnTheAxis) {
  Fitter fitter;
  Curve curve;
  const std::vector<Vec3> points = {{0, 1, 0}, {0.3, 1, 0}, {0.4, 1, 0}, {2, 1, 0}, {2.2, 1, 0}};
  ASSERT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
  for (const Vec3& p : curve.control_points()) {
    EXPECT_NEAR(p.y(), 1.0, 1e-14);
    EXPECT_EQ(p.z(), 0.0);
  }
}

TEST(Fit, StaysFiniteWithVeryUnequalChords) {
  test::RandomCurves random(24);
  Fitter fitter;
  Curve curve;
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec3> points = {Vec3::Zero()};
    for (int i = 0; i < 20; ++i) {
      const double chord = random.uniform(0, 1) < 0.5 ? 0.01 : 5.0;
      points.emplace_back(points.back() +
                          chord * Vec3(1, random.uniform(-0.2, 0.2), 0).normalized());
    }
    ASSERT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_LT((curve.position(fitter.parameters()[i]) - points[i]).norm(), 1e-11);
    }
    for (const Vec3& p : curve.control_points()) {
      ASSERT_TRUE(p.allFinite());
      ASSERT_LT(p.norm(), 1e3);
    }
  }
}

TEST(Fit, ConvergesWithTheFourthPowerOfTheChord) {
  Fitter fitter;
  Curve curve;
  const auto error = [&](int n) {
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i) {
      const double a = 2.0 * i / n;
      points.emplace_back(std::cos(a), std::sin(a), 0.0);
    }
    EXPECT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
    double worst = 0.0;
    for (double u = 0.3 * curve.u_max(); u < 0.7 * curve.u_max(); u += 1e-3) {
      worst = std::max(worst, std::abs(curve.position(u).norm() - 1.0));
    }
    return worst;
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4.0, 0.2);
}

TEST(Fit, RefusesTooFewCoincidentOrUndefinedPoints) {
  Fitter fitter;
  Curve curve;
  const EndCondition clamped{true, Vec3::UnitX(), Vec3::Zero()};
  const std::vector<Vec3> four = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}};
  ASSERT_EQ(fitter.fit(four, {}, {}, curve), FitResult::kFitted);
  const auto before = curve.control_points();
  EXPECT_EQ(fitter.fit(std::span(four).first(3), {}, {}, curve), FitResult::kTooFewPoints);
  EXPECT_EQ(fitter.fit(std::span(four).first(1), clamped, clamped, curve),
            FitResult::kTooFewPoints);
  EXPECT_EQ(fitter.fit({}, clamped, clamped, curve), FitResult::kTooFewPoints);
  EXPECT_EQ(fitter.fit(std::vector<Vec3>{four[0], four[1], four[1], four[3]}, {}, {}, curve),
            FitResult::kInvalidPoints);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fitter.fit(std::vector<Vec3>{four[0], four[1], {nan, 0, 0}, four[3]}, {}, {}, curve),
            FitResult::kInvalidPoints);
  EXPECT_EQ(curve.control_points(), before);
  EXPECT_EQ(fitter.fit(std::span(four).first(2), clamped, {}, curve), FitResult::kFitted);
  EXPECT_EQ(fitter.fit(std::span(four).first(2), {}, clamped, curve), FitResult::kFitted);
  EXPECT_EQ(fitter.fit(std::span(four).first(2), clamped, clamped, curve), FitResult::kFitted);
}

}  // namespace fit_test

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
    const Eigen::MatrixXd expected = test::solve_with_pivots(dense, right);
    for (int r = 0; r < n; ++r) {
      ASSERT_LT((x[r] - expected.row(r).transpose()).norm(), 1e-12);
    }
  }
}

}  // namespace banded_test
}  // namespace twin::geometry
