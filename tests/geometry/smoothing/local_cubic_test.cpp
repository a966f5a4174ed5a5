#include "geometry/smoothing/local_cubic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/linear_algebra.hpp"

namespace twin::geometry {
namespace local_cubic_test {

Polygon walk(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  Polygon polygon;
  polygon.start({1.0, 2.0, 3.0}, 4.0);
  Vec3 at(1.0, 2.0, 3.0);
  for (int i = 0; i < count; ++i) {
    at += Vec3(0.5 + 0.4 * part(random), 0.2 * part(random), 0.1 * part(random));
    polygon.push(at);
  }
  return polygon;
}

Stretch all_of(const Polygon& polygon) {
  return {&polygon, polygon.first(), polygon.last() - 1, polygon[polygon.first()].s,
          polygon[polygon.last()].s};
}

LocalCubic over(const Polygon& polygon, std::size_t block, double begin, double end) {
  const std::array<PathMoments, 1> whole{PathMoments(all_of(polygon), block, begin, end)};
  return LocalCubic(whole);
}

/// The path and, beyond its ends, its point reflection.
Vec3 path_at(const Stretch& all, double s) {
  const Polygon& polygon = *all.polygon;
  if (s < all.begin) {
    return 2.0 * polygon[all.first].at - path_at(all, 2.0 * all.begin - s);
  }
  if (s > all.end) {
    return 2.0 * polygon[all.last + 1].at - path_at(all, 2.0 * all.end - s);
  }
  return polygon.aim(polygon.block_at(s, all.first, all.first, all.last), s);
}

TEST(LocalCubic, IsTheLeastSquaresCubicOfManySamples) {
  const Polygon polygon = walk(3, 30);
  const Stretch all = all_of(polygon);
  for (const auto& [begin, end, part] : {std::tuple(6.0, 9.0, 1.0 / 3.0), std::tuple(3.0, 6.5, 0.5),
                                         std::tuple(all.end - 2.0, all.end + 1.0, 0.6),
                                         std::tuple(all.end - 2.0, all.end + 1.0, 0.9)}) {
    constexpr int kSamples = 20000;
    Eigen::MatrixXd a(kSamples, 4);
    Eigen::MatrixXd b(kSamples, 3);
    for (int i = 0; i < kSamples; ++i) {
      const double x = (2.0 * i + 1.0) / kSamples - 1.0;
      a.row(i) << 1.0, x, x * x, x * x * x;
      b.row(i) = path_at(all, begin + 0.5 * (x + 1.0) * (end - begin));
    }
    const Eigen::MatrixXd c = solve_symmetric(transposed_product(a, a), transposed_product(a, b));
    const double middle = 0.3;  // blossom of 1, x, x^2, x^3 at (-1, 0.3, 1)
    const Vec3 blossom = c.row(0) + middle / 3.0 * c.row(1) - c.row(2) / 3.0 - middle * c.row(3);
    const double rest = (a.lazyProduct(c) - b).squaredNorm() / kSamples;
    const std::size_t block = polygon.block_at(begin, 0, 0, all.last);
    const double border = begin + part * (end - begin);
    const std::array<PathMoments, 2> parts{PathMoments(all, block, begin, border),
                                           PathMoments(all, block, border, end)};
    const LocalCubic cubic(parts);
    EXPECT_LT((cubic.blossom(begin + 0.65 * (end - begin)) - blossom).norm(), 1e-6);
    EXPECT_NEAR(cubic.mean_square(), rest, 1e-6 * rest + 1e-10);
  }
}

TEST(LocalCubic, CountsABlockOnceThatTwoPartsShare) {
  const Polygon polygon = walk(5, 30);
  const Stretch all = all_of(polygon);
  const double begin = polygon[4].s;
  const double end = polygon[9].s;
  for (const double border : {polygon[6].s, 0.5 * (polygon[6].s + polygon[7].s)}) {
    const std::array<PathMoments, 2> parts{PathMoments(all, 4, begin, border),
                                           PathMoments(all, 4, border, end)};
    EXPECT_EQ(LocalCubic(parts).blocks(), 5);
  }
  EXPECT_EQ(over(polygon, 4, begin, end).blocks(), 5);
  EXPECT_EQ(over(polygon, 4, begin + 0.01, end + 0.01).blocks(), 6);
}

TEST(LocalCubic, LeavesNothingOfAStraightLine) {
  Polygon polygon;
  polygon.start({0, 0, 0}, 0.0);
  for (int i = 1; i < 50; ++i) {
    polygon.push({0.1 * i, 0.2 * i, 0.0});
  }
  const LocalCubic cubic = over(polygon, 3, 0.7, 5.0);
  EXPECT_LT(cubic.mean_square(), 1e-14);
  EXPECT_LT((cubic.blossom(2.0) - (0.7 + 2.0 + 5.0) / 3.0 * polygon[0].direction).norm(), 1e-12);
  EXPECT_NEAR(cubic.turn(), 0.0, 1e-12);
}

TEST(LocalCubic, KnowsHowFarACircleTurns) {
  Polygon polygon;
  polygon.start({5, 0, 0}, 0.0);
  for (int i = 1; i < 200; ++i) {
    polygon.push({5.0 * std::cos(0.01 * i), 5.0 * std::sin(0.01 * i), 0.0});
  }
  const LocalCubic cubic = over(polygon, 50, 3.0, 6.0);
  EXPECT_NEAR(cubic.turn(), 3.0 / 5.0, 0.02);
}

TEST(BlossomKernel, GivesTheBlossomOfAnyCubic) {
  const auto cubic = [](double s) { return 1.0 + s * (2.0 + s * (-3.0 + 0.5 * s)); };
  const double a = 1.0;
  const double b = 1.7;
  const double c = 4.0;
  const BlossomKernel kernel(a, b, c);
  double sum = 0.0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const double s = a + (c - a) * (i + 0.5) / kSteps;
    sum += cubic(s) * kernel.at(s) * (c - a) / kSteps;
  }
  EXPECT_NEAR(sum, 1.0 + 2.0 * (a + b + c) / 3.0 - (a * b + b * c + c * a) + 0.5 * a * b * c, 1e-7);
}

}  // namespace local_cubic_test
}  // namespace twin::geometry
