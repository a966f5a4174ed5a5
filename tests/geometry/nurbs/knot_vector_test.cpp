#include "geometry/nurbs/knot_vector.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "random_curve.hpp"

namespace twin::geometry {
namespace knot_vector_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string message(int degree, const std::vector<double>& knots, std::size_t points) {
  const auto result = check_knot_vector(degree, knots, points);
  return result ? "" : result.error().message;
}

TEST(KnotVector, AcceptsNonPeriodicKnotsWithInnerKnotsUpToDegreeTimes) {
  EXPECT_EQ(message(1, {0, 0, 1, 1}, 2), "");
  EXPECT_EQ(message(3, {-2, -2, -2, -2, 1, 1, 1, 5, 5, 5, 5}, 7), "");
}

TEST(KnotVector, NamesWhatIsWrong) {
  EXPECT_THAT(message(0, {0, 1}, 1), HasSubstr("degree 0 is outside 1..5"));
  EXPECT_THAT(message(6, std::vector<double>(14, 0.0), 7), HasSubstr("degree 6"));
  EXPECT_THAT(message(3, {0, 0, 0, 1, 1, 1}, 3), HasSubstr("3 control points are too few"));
  EXPECT_THAT(message(2, {0, 0, 0, 1, 1}, 3),
              HasSubstr("5 knots where 3 control points of degree 2 need 6"));
  EXPECT_THAT(message(2, {0, 0, 0, kNan, 1, 1, 1}, 4), HasSubstr("knot 3 is not a finite number"));
  EXPECT_THAT(message(1, {0, 0, kInfinity, kInfinity}, 2), HasSubstr("not a finite number"));
  EXPECT_THAT(message(1, {0, 0, 0.7, 0.6, 1, 1}, 4),
              HasSubstr("knot 3 (0.6) is below the one before it (0.7)"));
  EXPECT_THAT(message(2, {0, 0, 0.1, 1, 1, 1}, 3), HasSubstr("must each occur 3 times"));
  EXPECT_THAT(message(2, {0, 0, 0, 1, 1, 1.1}, 3), HasSubstr("must each occur 3 times"));
  EXPECT_THAT(message(2, {0, 0, 0, .5, .5, .5, 1, 1, 1}, 6), HasSubstr("repeated too often"));
  EXPECT_THAT(message(1, {0, 0, 0, 1, 1}, 3), HasSubstr("repeated too often"));
  EXPECT_THAT(message(1, {0, 0, 0, 0}, 2), HasSubstr("repeated too often"));
}

TEST(KnotVector, SpanHoldsTheParameterWhateverTheHint) {
  test::RandomCurves random(1);
  for (int round = 0; round < 2000; ++round) {
    const int degree = 1 + round % kMaxDegree;
    const int count = degree + 1 + round % 17;
    const auto knots = random.knots(degree, count);
    double u = random.uniform(-1.0, 2.0);
    if (round % 3 == 0) {
      u = knots[static_cast<std::size_t>(round) % knots.size()];
    }
    const int hint = static_cast<int>(random.uniform(-3, count + 3));
    const int s = find_span(degree, knots, u, hint);
    ASSERT_GE(s, degree);
    ASSERT_LT(s, count);
    ASSERT_LE(knots[s], u);
    ASSERT_TRUE(u < knots[s + 1] || (u == 2.0 && s == count - 1));
    ASSERT_LT(knots[s], knots[s + 1]);
  }
}

TEST(KnotVector, SpanOfAnyDoubleIsInTheDomain) {
  const std::vector<double> knots = {0, 0, 0, 1, 2, 2, 2};
  EXPECT_EQ(find_span(2, knots, kNan, -1), 2);
  EXPECT_EQ(find_span(2, knots, kNan, 3), 2);
  EXPECT_EQ(find_span(2, knots, -kInfinity, 3), 2);
  EXPECT_EQ(find_span(2, knots, kInfinity, 2), 3);
  EXPECT_EQ(find_span(2, knots, 2.0, std::numeric_limits<int>::max()), 3);
  EXPECT_EQ(find_span(2, knots, 1.0, std::numeric_limits<int>::min()), 3);
  EXPECT_EQ(find_span(2, knots, std::nextafter(1.0, 0.0), 3), 2);
}

TEST(KnotVector, AveragesEveryPSuccessiveParameters) {
  std::vector<double> knots;
  average_knots(3, std::vector<double>{0, 1, 3, 5, 9, 10}, knots);
  EXPECT_THAT(knots, ElementsAre(0, 0, 0, 0, 3, 17.0 / 3, 10, 10, 10, 10));
  average_knots(3, std::vector<double>{0, 0, 0, 3, 6, 6, 6}, knots);  // two clamped ends
  EXPECT_THAT(knots, ElementsAre(0, 0, 0, 0, 1, 3, 5, 6, 6, 6, 6));
}

}  // namespace knot_vector_test
}  // namespace twin::geometry
