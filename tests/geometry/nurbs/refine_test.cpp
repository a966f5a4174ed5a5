#include "geometry/nurbs/refine.hpp"

#include <gtest/gtest.h>

#include <random>

#include "butterfly.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {
namespace refine_test {

/// Largest distance of two curves at the same parameters within the second one's domain.
double distance(const Curve& whole, const Curve& part) {
  double largest = 0.0;
  for (int i = 0; i <= 500; ++i) {
    const double u = part.u_min() + (part.u_max() - part.u_min()) * i / 500.0;
    largest = std::max(largest, (whole.position(u) - part.position(u)).norm());
  }
  return largest;
}

Curve random_curve(std::mt19937& random, int degree, bool is_rational) {
  std::uniform_real_distribution<double> number(0.0, 1.0);
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  for (int i = 0; i < 6; ++i) {
    knots.push_back(knots.back() + 0.1 + number(random));
    if (degree > 1 && number(random) < 0.3) {
      knots.push_back(knots.back());
    }
  }
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, knots.back() + 0.5);
  std::vector<Vec3> points(knots.size() - static_cast<std::size_t>(degree) - 1);
  std::vector<double> weights;
  for (Vec3& point : points) {
    point = 10.0 * Vec3(number(random), number(random), number(random));
    weights.push_back(0.2 + number(random));
  }
  return *Curve::create(degree, knots, points, is_rational ? weights : std::vector<double>{});
}

TEST(Refine, DoesNotMoveTheCurve) {
  std::mt19937 random(3);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    for (const bool is_rational : {false, true}) {
      const Curve curve = random_curve(random, degree, is_rational);
      std::vector<double> knots;
      for (std::size_t i = 0; i < curve.knots().size(); ++i) {
        knots.push_back(curve.knots()[i]);
        if (i + 1 < curve.knots().size() && curve.knots()[i] < curve.knots()[i + 1]) {
          knots.push_back(0.3 * curve.knots()[i] + 0.7 * curve.knots()[i + 1]);
        }
      }
      const Curve refined = refine(curve, knots);
      EXPECT_EQ(refined.knots(), knots);
      EXPECT_LT(distance(curve, refined), 1e-13) << degree;
    }
  }
}

TEST(Refine, PartBetweenTwoParameters) {
  const Curve curve = test::butterfly();
  const double from = 0.2;
  const double to = 0.23;  // one knot of the curve between them
  const Curve part = refine(curve, {from, from, from, from, 0.2273, to, to, to, to});
  EXPECT_EQ(part.u_min(), from);
  EXPECT_EQ(part.u_max(), to);
  EXPECT_LT(distance(curve, part), 1e-12);
}

TEST(Split, PiecesAreTheCurveAndShareTheirEnds) {
  const Curve curve = test::butterfly();
  for (const int most : {1, 7, 20, 1000}) {
    const std::vector<Curve> pieces = split(curve, {0, most});
    EXPECT_EQ(pieces.size(), static_cast<std::size_t>((48 + most - 1) / most));
    EXPECT_EQ(pieces.front().control_points().front(), curve.control_points().front());
    EXPECT_EQ(pieces.back().control_points().back(), curve.control_points().back());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      EXPECT_LT(distance(curve, pieces[i]), 1e-11);
      if (i > 0) {
        EXPECT_EQ(pieces[i].u_min(), pieces[i - 1].u_max());
        EXPECT_EQ(pieces[i].control_points().front(), pieces[i - 1].control_points().back());
      }
    }
  }
}

TEST(Split, BezierPiecesHaveDegreeAndOneControlPointsEach) {
  std::mt19937 random(5);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    const Curve curve = random_curve(random, degree, true);
    for (const Curve& piece : bezier_pieces(curve)) {
      EXPECT_EQ(piece.control_points().size(), static_cast<std::size_t>(degree) + 1);
      EXPECT_LT(distance(curve, piece), 1e-12);
    }
  }
}

TEST(Split, CutsWhereTooFewDerivativesAreContinuous) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 1, 0},
                                    {4, 0, 0}, {5, 1, 0}, {6, 0, 0}};
  // Knot 1 once (C2), knot 2 twice (C1).
  const Curve curve = *Curve::create(3, {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3}, points);
  EXPECT_EQ(split(curve, {0, 0}).size(), 1U);
  EXPECT_EQ(split(curve, {1, 0}).size(), 1U);
  EXPECT_EQ(split(curve, {2, 0}).size(), 2U);
  EXPECT_EQ(split(curve, {3, 0}).size(), 3U);
  EXPECT_EQ(split(curve, {2, 0})[0].u_max(), 2.0);
}

}  // namespace refine_test
}  // namespace twin::geometry
