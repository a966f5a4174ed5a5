#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/nc_file.hpp"

namespace twin::test {
namespace outline_programs_test {

/// Figures of one program: Table 1 of the paper (blocks and lengths) and what the outline was made
/// for.
struct Expected {
  const char* name;
  std::size_t blocks;
  double longest, shortest, mean;  ///< Table 1 [mm]
  double path;                     ///< whole programmed path [mm]
  int rounds;                      ///< tight rounds
};

/// Points around the outline: the program without its first and last point, X0 Y0.
std::vector<Point> outline_of(const std::string& name) {
  std::vector<Point> p = polygon(name);
  p.erase(p.begin());
  p.pop_back();
  return p;
}

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Curvature of the circle through each point of the closed outline and its two neighbours [1/mm].
std::vector<double> curvatures(const std::vector<Point>& closed) {
  const std::size_t n = closed.size() - 1;
  std::vector<double> out;
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = closed[i] - closed[(i + n - 1) % n];
    const Point b = closed[i + 1] - closed[i];
    out.push_back(2.0 * cross(a, b) / (a.norm() * b.norm() * (a + b).norm()));
  }
  return out;
}

class OutlineProgram : public testing::TestWithParam<Expected> {};

TEST_P(OutlineProgram, BlockLengthsAreThoseOfTable1) {
  const Expected& e = GetParam();
  const std::vector<double> l = lengths(outline_of(e.name));
  ASSERT_EQ(l.size(), e.blocks);
  const double half = 0.0005;  // equal when written with three decimals
  EXPECT_NEAR(*std::max_element(l.begin(), l.end()), e.longest, half);
  EXPECT_NEAR(*std::min_element(l.begin(), l.end()), e.shortest, half);
  EXPECT_NEAR(std::accumulate(l.begin(), l.end(), 0.0) / static_cast<double>(l.size()), e.mean,
              half);
}

TEST_P(OutlineProgram, OutlineClosesAndThePathHasItsLength) {
  const Expected& e = GetParam();
  const std::vector<Point> p = polygon(e.name);
  EXPECT_EQ(p[1], p[p.size() - 2]);
  EXPECT_EQ(p.back(), Point::Zero());
  const std::vector<double> l = lengths(p);
  EXPECT_NEAR(std::accumulate(l.begin(), l.end(), 0.0), e.path, 0.01);
}

TEST_P(OutlineProgram, ApproachAndReturnStandSquareOnTheOutline) {
  const std::vector<Point> p = outline_of(GetParam().name);
  const Point in = p.front().normalized();
  const Point along = (p[1] - p[p.size() - 2]).normalized();
  EXPECT_LT(std::abs(in.dot(along)), 0.02);
  EXPECT_LT(std::abs(curvatures(p).front()), 0.06);
}

TEST_P(OutlineProgram, TightRoundsHaveARadiusJustUnderOneMillimetre) {
  const Expected& e = GetParam();
  const std::vector<double> k = curvatures(outline_of(e.name));
  int rounds = 0;
  bool inside = false;
  for (const double kappa : k) {
    const double a = std::abs(kappa);
    EXPECT_LT(a, 1.08);
    if (a > 0.98 && !inside) {
      ++rounds;
      inside = true;
    }
    inside = inside && a > 0.5;
  }
  EXPECT_EQ(rounds, e.rounds);
}

TEST_P(OutlineProgram, CurvatureIsModerateOutsideTheRounds) {
  const std::vector<Point> p = outline_of(GetParam().name);
  const std::vector<double> k = curvatures(p);
  const std::vector<double> l = lengths(p);
  const std::size_t n = k.size();
  // 1.5 mm on either side of a point above 0.9 belong to its round
  std::vector<bool> round(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(k[i]) <= 0.9) {
      continue;
    }
    round[i] = true;
    double ahead = 0.0;
    double behind = 0.0;
    for (std::size_t j = 1; ahead < 1.5 || behind < 1.5; ++j) {
      ahead += l[(i + j - 1) % n];
      behind += l[(i + n - j) % n];
      if (ahead < 1.5) round[(i + j) % n] = true;
      if (behind < 1.5) round[(i + n - j) % n] = true;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!round[i]) {
      EXPECT_LT(std::abs(k[i]), 0.25) << "point " << i;
    }
  }
}

TEST_P(OutlineProgram, NeighbouringBlocksDifferByAQuarterAtMost) {
  const std::vector<double> l = lengths(outline_of(GetParam().name));
  for (std::size_t i = 0; i < l.size(); ++i) {
    const double ratio = l[(i + 1) % l.size()] / l[i];
    EXPECT_LT(std::max(ratio, 1.0 / ratio), 1.25) << "block " << i;
  }
}

TEST_P(OutlineProgram, EveryCornerIsPastTheCriticalAngleOfTable2) {
  const std::vector<Point> p = outline_of(GetParam().name);
  const double limit = (180.0 - 172.8) * 3.14159265358979 / 180.0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Point a = p[i] - p[i - 1];
    const Point b = p[i + 1] - p[i];
    EXPECT_LT(std::abs(std::atan2(cross(a, b), a.dot(b))), limit) << "point " << i;
  }
}

TEST_P(OutlineProgram, SagittaStaysAtTheMicrometre) {
  const std::vector<Point> p = outline_of(GetParam().name);
  const std::vector<double> k = curvatures(p);
  const std::vector<double> l = lengths(p);
  double sum = 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < l.size(); ++i) {
    const double kappa = 0.5 * std::abs(k[i] + k[(i + 1) % k.size()]);
    const double sagitta = l[i] * l[i] * kappa / 8.0;
    EXPECT_LT(sagitta, 0.00155) << "block " << i;
    sum += 8.0 / 15.0 * sagitta * sagitta * l[i];  // mean square of a parabola of this height
    length += l[i];
  }
  EXPECT_LT(std::sqrt(sum / length), 0.00066);  // the smaller RMS of Table 3
}

INSTANTIATE_TEST_SUITE_P(Table1, OutlineProgram,
                         testing::Values(Expected{"oxalis.nc", 1006, 0.580, 0.091, 0.262, 309.0, 6},
                                         Expected{"dolphin.nc", 1221, 0.743, 0.106, 0.329, 453.75,
                                                  8}),
                         [](const auto& tested) {
                           const std::string name = tested.param.name;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace outline_programs_test
}  // namespace twin::test
