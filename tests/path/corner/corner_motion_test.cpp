#include "path/corner/corner_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "path/corner/corner_table.hpp"
#include "tests/support/blocks.hpp"

// Passages of corners in space, judged by differences of their points in time: differences of order k
// never exceed the largest derivative of order k.
namespace twin::path {
namespace corner_motion_test {

constexpr double kDoubt = 1.0 + 1e-5;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<>(low, high)(random);
}

Vec3 any_direction(std::mt19937& random) {
  return Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)).normalized();
}

struct Corner {
  Vec3 place, incoming, outgoing;
  CornerDemand demand;
};

Corner any_corner(std::mt19937& random) {
  Corner corner;
  corner.place = 50.0 * any_direction(random);
  corner.incoming = any_direction(random);
  const Vec3 across = corner.incoming.cross(any_direction(random)).normalized();
  const double turn = std::numbers::pi * std::pow(uniform(random, 0.0, 1.0), 2.0);
  corner.outgoing = std::cos(turn) * corner.incoming + std::sin(turn) * across;
  corner.demand.feedrate = std::pow(10.0, uniform(random, 0.0, 2.2));
  corner.demand.tolerance = std::pow(10.0, uniform(random, -3.0, -1.0));
  corner.demand.acceleration = uniform(random, 800.0, 5000.0);
  corner.demand.jerk = std::pow(10.0, uniform(random, 4.0, 5.5));
  return corner;
}

/// Largest differences of points over a step of time, as a velocity, an acceleration and a jerk.
struct Peaks {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;

  Peaks(const std::vector<Vec3>& p, double step) {
    for (std::size_t i = 3; i < p.size(); ++i) {
      velocity = std::max(velocity, (p[i] - p[i - 1]).norm() / step);
      acceleration =
          std::max(acceleration, (p[i] - 2.0 * p[i - 1] + p[i - 2]).norm() / (step * step));
      jerk = std::max(
          jerk, (p[i] - 3.0 * p[i - 1] + 3.0 * p[i - 2] - p[i - 3]).norm() / (step * step * step));
    }
  }
};

/// The passage at a share of its feedrate, with the legs before and after it.
std::vector<Vec3> points_of(const CornerMotion& passage, const Vec3& incoming, const Vec3& outgoing,
                            double share, double step) {
  const double v = share * passage.feedrate;
  const double duration = passage.duration() / share;
  std::vector<Vec3> points;
  for (double t = -5.3 * step; t < duration + 6.0 * step; t += step) {
    const double after = t - duration;
    points.push_back(t < 0.0       ? Vec3(passage.corner + (v * t - passage.way) * incoming)
                     : after > 0.0 ? Vec3(passage.corner + (v * after + passage.way) * outgoing)
                                   : motion_in(passage, v * t, v, 0.0).position);
  }
  return points;
}

TEST(CornerMotion, KeepsEveryLimitAsAVectorAndTheTolerance) {
  std::mt19937 random(1);
  int found = 0;
  for (int i = 0; i < 150; ++i) {
    const Corner corner = any_corner(random);
    CornerTable table;
    const auto passage = table.find(corner.place, corner.incoming, corner.outgoing, corner.demand);
    if (!passage) {
      continue;
    }
    ++found;
    const double step = passage->duration() / 400.0;
    const auto points = points_of(*passage, corner.incoming, corner.outgoing, 1.0, step);
    const Peaks peaks(points, step);
    const double rounding = 8.0 * 1e-14 / (step * step * step);
    ASSERT_LE(peaks.velocity, corner.demand.feedrate * kDoubt) << i;
    ASSERT_LE(peaks.acceleration, corner.demand.acceleration * kDoubt) << i;
    ASSERT_LE(peaks.jerk, corner.demand.jerk * kDoubt + rounding) << i;
    const Vec3 far = 1e3 * passage->way * corner.incoming;
    const Vec3 farther = 1e3 * passage->way * corner.outgoing;
    double nearest = 1e9;
    for (const Vec3& p : points) {
      const double away = std::min(test::distance_to(p, corner.place - far, corner.place),
                                   test::distance_to(p, corner.place, corner.place + farther));
      ASSERT_LE(away, passage->deviation + 1e-9) << i;
      nearest = std::min(nearest, (p - corner.place).norm());
    }
    ASSERT_LE(nearest, corner.demand.tolerance + step * corner.demand.feedrate) << i;
    ASSERT_LE(passage->deviation, corner.demand.tolerance * kDoubt) << i;
  }
  EXPECT_GT(found, 130);
}

TEST(CornerMotion, KeepsTheLimitsOfEveryAxis) {
  std::mt19937 random(11);
  int found = 0;
  int reached = 0;
  for (int i = 0; i < 200; ++i) {
    Corner corner = any_corner(random);
    for (CornerAxis& axis : corner.demand.axes) {
      axis.acceleration = random() % 4 == 0 ? 0.0 : uniform(random, 300.0, 3000.0);
      axis.jerk = random() % 4 == 0 ? 0.0 : std::pow(10.0, uniform(random, 3.5, 5.0));
    }
    CornerTable table;
    const auto passage = table.find(corner.place, corner.incoming, corner.outgoing, corner.demand);
    if (!passage) {
      continue;
    }
    ++found;
    const double step = passage->duration() / 400.0;
    const auto p = points_of(*passage, corner.incoming, corner.outgoing, 1.0, step);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const CornerAxis& axis = corner.demand.axes[static_cast<std::size_t>(k)];
      double acceleration = 0.0;
      double jerk = 0.0;
      for (std::size_t n = 3; n < p.size(); ++n) {
        const double second = p[n][k] - 2.0 * p[n - 1][k] + p[n - 2][k];
        const double third = second - (p[n - 1][k] - 2.0 * p[n - 2][k] + p[n - 3][k]);
        acceleration = std::max(acceleration, std::abs(second) / (step * step));
        jerk = std::max(jerk, std::abs(third) / (step * step * step));
      }
      const double rounding = 1e-13 / (step * step * step);
      if (axis.jerk > 0.0) {
        ASSERT_LE(jerk, axis.jerk * kDoubt + rounding) << i << " axis " << k;
        reached += jerk > 0.97 * axis.jerk ? 1 : 0;
      }
      if (axis.acceleration > 0.0) {
        ASSERT_LE(acceleration, axis.acceleration * kDoubt + rounding * step) << i;
      }
    }
  }
  EXPECT_GT(found, 150);
  EXPECT_GT(reached, 80);
}

TEST(CornerMotion, AtAShareOfItsFeedrateIsTheSameCurveWithTheCubeOfTheJerk) {
  CornerTable table;
  const auto passage =
      table.find(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), {0.0, 50.0, 0.01, 2450.0, 50000.0});
  ASSERT_TRUE(passage);
  const double step = passage->duration() / 300.0;
  const auto whole = points_of(*passage, Vec3::UnitX(), Vec3::UnitY(), 1.0, step);
  const auto half = points_of(*passage, Vec3::UnitX(), Vec3::UnitY(), 0.5, 2.0 * step);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    ASSERT_LT((whole[i] - half[i]).norm(), 1e-9);
  }
  EXPECT_NEAR(Peaks(half, 2.0 * step).jerk, Peaks(whole, step).jerk / 8.0, 50.0);
}

// A feedrate that swings between rest and the slow feedrate, with the acceleration and jerk that are
// left for it, whatever it does.
TEST(CornerMotion, AFeedrateThatChangesSlowlyKeepsTheLimits) {
  std::mt19937 random(2);
  for (int i = 0; i < 60; ++i) {
    const Corner corner = any_corner(random);
    CornerTable table;
    const auto passage = table.find(corner.place, corner.incoming, corner.outgoing, corner.demand);
    if (!passage) {
      continue;
    }
    const SlowPassage slow = slow_passage(*passage);
    const double step =
        0.01 * std::min(slow.acceleration / slow.jerk, passage->length() / slow.feedrate);
    double s = 0.0, v = uniform(random, 0.0, slow.feedrate), a = 0.0, j = 0.0;
    std::vector<Vec3> points;
    for (int k = 0; k < 20000 && s < passage->length(); ++k) {
      if (k % 7 == 0) {  // as much as A and the way out to 0 or to the slow feedrate allow
        j = slow.jerk * (random() % 2 == 0 ? 1.0 : -1.0);
        const double after = a + 7.0 * step * j;
        const double end =
            v + 7.0 * step * (a + after) / 2.0 + after * std::abs(after) / (2.0 * slow.jerk);
        j = std::abs(after) > slow.acceleration ? 0.0
            : end > slow.feedrate               ? -slow.jerk
            : end < 0.05 * slow.feedrate        ? slow.jerk
                                                : j;
      }
      a = std::clamp(a + step * j, -slow.acceleration, slow.acceleration);
      if (v + step * a > slow.feedrate || v + step * a < 0.0) {
        break;
      }
      points.push_back(motion_in(*passage, s, v, a).position);
      s += step * (v + step * a / 2.0);
      v += step * a;
    }
    if (points.size() > 3) {
      const Peaks peaks(points, step);
      const double rounding = 8.0 * 1e-14 / (step * step * step);
      ASSERT_LE(peaks.acceleration, 1.02 * corner.demand.acceleration) << i;
      ASSERT_LE(peaks.jerk, 1.1 * corner.demand.jerk + rounding) << i;  // v goes by steps here
    }
  }
}

// What motion_in() says of velocity and acceleration is what its positions do.
TEST(CornerMotion, DerivativesAreThoseOfThePosition) {
  CornerTable table;
  const auto passage = table.find({1.0, 2.0, 3.0}, Vec3::UnitX(), Vec3(-0.6, 0.0, 0.8),
                                  {0.0, 40.0, 0.01, 2450.0, 50000.0});
  ASSERT_TRUE(passage);
  const double v = 20.0, a = 300.0, h = 1e-5;
  for (double s = 0.05; s < passage->length() - 0.05; s += 0.037) {
    const auto at = [&](double t) {
      return motion_in(*passage, s + v * t + 0.5 * a * t * t, v + a * t, a);
    };
    ASSERT_LT((at(0.0).velocity - (at(h).position - at(-h).position) / (2.0 * h)).norm(), 1e-4);
    ASSERT_LT((at(0.0).acceleration - (at(h).velocity - at(-h).velocity) / (2.0 * h)).norm(), 1.0);
  }
}

TEST(CornerTable, APassageDoesNotDependOnTheCornersBefore) {
  std::mt19937 random(3);
  const CornerDemand demand{0.0, 30.0, 0.01, 2450.0, 50000.0};
  CornerTable used;
  for (int i = 0; i < 20; ++i) {
    const double turn = uniform(random, 0.1, 3.1);
    const Vec3 outgoing(std::cos(turn), std::sin(turn), 0.0);
    CornerTable fresh;
    const auto a = used.find(Vec3::Zero(), Vec3::UnitX(), outgoing, demand);
    const auto b = fresh.find(Vec3::Zero(), Vec3::UnitX(), outgoing, demand);
    ASSERT_TRUE(a && b);
    ASSERT_EQ(a->way, b->way);
    ASSERT_EQ(a->duration(), b->duration());
  }
}

TEST(CornerTable, AnExactReversalIsAStraightWayThereAndBack) {
  CornerTable table;
  const auto passage =
      table.find(Vec3::Zero(), Vec3::UnitX(), -Vec3::UnitX(), {0.0, 50.0, 0.01, 2450.0, 50000.0});
  ASSERT_TRUE(passage);
  for (double s = 0.0; s < passage->length(); s += 0.01) {
    const SpaceMotion at = motion_in(*passage, s, 50.0, 0.0);
    ASSERT_NEAR(at.position.y(), 0.0, 1e-12);
    ASSERT_LE(at.position.x(), 0.0);
  }
}

}  // namespace corner_motion_test
}  // namespace twin::path
