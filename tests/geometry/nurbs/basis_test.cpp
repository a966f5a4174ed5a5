#include "geometry/nurbs/basis.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "naive.hpp"
#include "random_curve.hpp"

namespace twin::geometry {
namespace basis_test {

/// Calls check(knots, span, u, basis) at random places of random knot vectors, ends and knots
/// included.
template <int P, class Check>
void everywhere(Check check) {
  test::RandomCurves random(10 + P);
  for (int round = 0; round < 300; ++round) {
    const int count = P + 1 + round % 9;
    const auto knots = random.knots(P, count);
    for (double u :
         {random.uniform(-1, 2), knots[static_cast<std::size_t>(round) % knots.size()], 2.0}) {
      const int span = find_span(P, knots, u, -1);
      check(knots, span, u, evaluate_basis<P>(knots.data() + span, u));
    }
  }
}

template <class T>
class BasisOfDegree : public ::testing::Test {};
using Degrees = ::testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                 std::integral_constant<int, 3>, std::integral_constant<int, 4>,
                                 std::integral_constant<int, 5>>;
TYPED_TEST_SUITE(BasisOfDegree, Degrees);

TYPED_TEST(BasisOfDegree, IsAPartitionOfUnityWithoutNegativeParts) {
  everywhere<TypeParam::value>([](const auto&, int, double, const auto& basis) {
    EXPECT_NEAR(std::accumulate(basis.n.begin(), basis.n.end(), 0.0), 1.0, 1e-14);
    EXPECT_NEAR(std::accumulate(basis.n1.begin(), basis.n1.end(), 0.0), 1.0, 1e-14);
    for (const double n : basis.n) {
      EXPECT_GE(n, 0.0);
    }
  });
}

TYPED_TEST(BasisOfDegree, EqualsTheRecursionAsDefined) {
  constexpr int kP = TypeParam::value;
  everywhere<kP>([](const auto& knots, int span, double u, const auto& basis) {
    for (int j = 0; j <= kP; ++j) {
      EXPECT_NEAR(basis.n[j], test::naive_basis(knots, span - kP + j, kP, u), 1e-13);
    }
    for (int j = 0; j < kP; ++j) {
      EXPECT_NEAR(basis.n1[j], test::naive_basis(knots, span - kP + 1 + j, kP - 1, u), 1e-13);
    }
    for (int j = 0; j + 1 < kP; ++j) {
      EXPECT_NEAR(basis.n2[j], test::naive_basis(knots, span - kP + 2 + j, kP - 2, u), 1e-13);
    }
  });
}

TYPED_TEST(BasisOfDegree, AllOtherFunctionsVanishOnTheSpan) {
  constexpr int kP = TypeParam::value;
  everywhere<kP>([](const auto& knots, int span, double u, const auto&) {
    for (int i = 0; i + kP + 1 < static_cast<int>(knots.size()); ++i) {
      if (i < span - kP || i > span) {
        EXPECT_EQ(test::naive_basis(knots, i, kP, u), 0.0);
      }
    }
  });
}

TYPED_TEST(BasisOfDegree, KeepsTheKnotDifferencesForTheDerivatives) {
  constexpr int kP = TypeParam::value;
  everywhere<kP>([](const auto& knots, int span, double, const auto& basis) {
    for (int j = 0; j < kP; ++j) {
      EXPECT_DOUBLE_EQ(1.0 / basis.inv1[j], knots[span + 1 + j] - knots[span - kP + 1 + j]);
    }
    for (int j = 0; j + 1 < kP; ++j) {
      EXPECT_DOUBLE_EQ(1.0 / basis.inv2[j], knots[span + 1 + j] - knots[span - kP + 2 + j]);
    }
  });
}

}  // namespace basis_test
}  // namespace twin::geometry
