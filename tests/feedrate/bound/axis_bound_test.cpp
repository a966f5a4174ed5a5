#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "bound_of.hpp"
#include "tests/support/blocks.hpp"

/// The bound where axes have limits of their own.
namespace twin::feedrate {
namespace axis_bound_test {

using test::arc_block;
using test::bound_of;
using test::line_block;
using test::PlanSettings;

PlanSettings with_axes(const Vec3& feedrate, const Vec3& acceleration) {
  PlanSettings settings;
  settings.limits.axis_feedrate = feedrate;
  settings.limits.axis_acceleration = acceleration;
  return settings;
}

TEST(AxisBound, ALineKeepsTheTighterAxis) {
  // 3:4 in X and Y: 10 mm/s in X allow 50/3 mm/s, 800 mm/s^2 in Y allow 1000 mm/s^2 along the line.
  const auto settings = with_axes({10, 0, 0}, {0, 800, 0});
  const double v = 50.0 / 3.0;
  EXPECT_NEAR(bound_of({line_block({0, 0, 0}, {30, 40, 0})}, settings), 50.0 / v + v / 1000.0,
              1e-9);
}

TEST(AxisBound, LimitsOfAxesThatDoNotBindChangeNothing) {
  const std::vector<gcode::Block> blocks{
      line_block({0, 0, 0}, {10, 0, 0}),
      arc_block({10, 0, 0}, {1, 0, 0}, 2.0, 2.0 * std::numbers::pi, true)};
  const double free = bound_of(blocks);
  EXPECT_NEAR(bound_of(blocks, with_axes({1e4, 1e4, 1e4}, {1e6, 1e6, 1e6})), free, 1e-3 * free);
}

/// On a circle about the origin x'' = u T_x + q K_x, and so y''; seen at the set points of the
/// profile, not by the planner's own lines.
TEST(AxisBound, OnACircleEachAxisKeepsItsAccelerationAndOneReachesIt) {
  const double radius = 1.0;
  const double most = 1200.0;
  const auto settings = with_axes(Vec3::Zero(), {most, most, 0});
  const auto arc = arc_block({radius, 0, 0}, {0, 1, 0}, radius, 4.0 * std::numbers::pi, true);
  std::vector<test::At> profile;
  bound_of({arc}, settings, &profile);
  double peak = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double length = profile[i].s - profile[i - 1].s;
    if (length <= 0.0) {
      continue;
    }
    const double u =
        (profile[i].v * profile[i].v - profile[i - 1].v * profile[i - 1].v) / (2.0 * length);
    const double angle = 0.5 * (profile[i].s + profile[i - 1].s) / radius;
    const double q = 0.5 * (profile[i].v * profile[i].v + profile[i - 1].v * profile[i - 1].v);
    const double x = -u * std::sin(angle) - q / radius * std::cos(angle);
    const double y = u * std::cos(angle) - q / radius * std::sin(angle);
    peak = std::max({peak, std::abs(x), std::abs(y)});
  }
  EXPECT_LE(peak, 1.01 * most);
  EXPECT_GE(peak, 0.99 * most);
}

/// The same problem by another way: an even grid, the limits of each axis at the begin of each step
/// alone, and the controllable set by bisection over q.
class EvenGrid {
 public:
  EvenGrid(double radius, double angle, const Vec3& most, double cap, int steps)
      : radius_(radius), most_(most), angle_(angle), step_(radius * angle / steps) {
    q_.assign(static_cast<std::size_t>(steps) + 1, cap * cap);
    q_.back() = 0.0;
  }

  double time() {
    for (std::size_t i = q_.size() - 1; i-- > 0;) {
      double low = 0.0;
      double high = q_[i];
      for (int k = 0; k < 45 && !is_controllable(i, q_[i]); ++k) {
        const double middle = 0.5 * (low + high);
        (is_controllable(i, middle) ? low : high) = middle;
        q_[i] = k == 44 ? low : q_[i];
      }
    }
    q_.front() = 0.0;
    double time = 0.0;
    for (std::size_t i = 0; i + 1 < q_.size(); ++i) {
      const auto [low, high] = range(i, q_[i]);
      q_[i + 1] = std::clamp(q_[i] + 2.0 * step_ * high, 0.0, q_[i + 1]);
      time += 2.0 * step_ / (std::sqrt(q_[i]) + std::sqrt(q_[i + 1]));
    }
    return time;
  }

 private:
  std::pair<double, double> range(std::size_t i, double q) const {
    const double angle = angle_ * static_cast<double>(i) / static_cast<double>(q_.size() - 1);
    const double t[2] = {-std::sin(angle), std::cos(angle)};
    const double k[2] = {-std::cos(angle) / radius_, -std::sin(angle) / radius_};
    std::pair<double, double> u{-2450.0, 2450.0};
    for (int axis = 0; axis < 2; ++axis) {
      const double at = t[axis];
      if (std::abs(at) < 1e-9) {
        if (std::abs(k[axis] * q) > most_[axis]) {
          return {1.0, -1.0};
        }
        continue;
      }
      const double a = (most_[axis] - k[axis] * q) / at;
      const double b = (-most_[axis] - k[axis] * q) / at;
      u = {std::max(u.first, std::min(a, b)), std::min(u.second, std::max(a, b))};
    }
    return u;
  }

  bool is_controllable(std::size_t i, double q) const {
    const auto [low, high] = range(i, q);
    const double least = std::max(low, -0.5 * q / step_);
    return least <= high && q + 2.0 * step_ * least <= q_[i + 1];
  }

  double radius_;
  Vec3 most_;
  double angle_;
  double step_;
  std::vector<double> q_;
};

TEST(AxisBound, OnACircleItIsThatOfAnotherAlgorithm) {
  const double angle = 4.0 * std::numbers::pi;
  const auto arc = arc_block({1, 0, 0}, {0, 1, 0}, 1.0, angle, true);
  for (const Vec3& most : {Vec3(1200, 1200, 0), Vec3(600, 2000, 0), Vec3(2000, 900, 0)}) {
    auto settings = with_axes(Vec3::Zero(), most);
    settings.model.circular_error = 1e6;
    const double cap = std::sqrt(2450.0);  // of the normal acceleration
    const double other = EvenGrid(1.0, angle, most, cap, 8000).time();
    const double bound = bound_of({arc}, settings);
    EXPECT_NEAR(bound, other, 5e-4 * other) << most.transpose();
    EXPECT_LE(bound, other * (1.0 + 1e-5)) << most.transpose();
  }
}

TEST(AxisBound, EqualAxesAreSlowerThanTheirInscribedCircleNowhereAndFasterThanTheirSquareNowhere) {
  // |a| <= A keeps |a_x|, |a_y| <= A, which keep |a| <= sqrt(2) A.
  PlanSettings round;
  round.model.circular_error = 1e6;
  const auto arc = arc_block({1, 0, 0}, {0, 1, 0}, 1.0, 6.0 * std::numbers::pi, true, 150.0);
  const double a = 1000.0;
  auto axes = round;
  axes.limits.axis_acceleration = {a, a, 0};
  axes.limits.acceleration = 1e5;
  const double steady = std::sqrt(a);  // q = a r all the way round is allowed, no less
  const double length = 6.0 * std::numbers::pi;
  const double bound = bound_of({arc}, axes);
  EXPECT_LE(bound, length / steady + 2.0 * steady / a);
  EXPECT_GE(bound, length / std::sqrt(std::numbers::sqrt2 * a));
}

}  // namespace axis_bound_test
}  // namespace twin::feedrate
