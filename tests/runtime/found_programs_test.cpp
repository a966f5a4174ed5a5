#include <gtest/gtest.h>
#include <numbers>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/set_points.hpp"
#include "tests/runtime/run_fixture.hpp"
#include "tests/support/program_text.hpp"

// Programs that random search has found: what went wrong with each must not come back.
namespace twin::runtime {
namespace found_programs_test {

class FoundProgram : public RunProgram {
 protected:
  /// All set points; fails where they do not end.
  std::vector<motion::SetPoint> follow(const std::string& text) {
    auto points = SetPoints::open(gcode::ProgramText::from_text(text, "found"), request.machine);
    EXPECT_TRUE(points);
    std::vector<motion::SetPoint> all;
    motion::SetPoint point;
    while (points && all.size() < 100000 && points->next(point)) {
      all.push_back(point);
    }
    EXPECT_LT(all.size(), 100000U);
    EXPECT_FALSE(points->error());
    return all;
  }
  double period() const { return request.machine.period; }
};

/// Steps between successive set points [mm].
std::vector<Vec3> steps_of(const std::vector<motion::SetPoint>& points) {
  std::vector<Vec3> steps;
  for (std::size_t i = 1; i < points.size(); ++i) {
    steps.push_back(points[i].position - points[i - 1].position);
  }
  return steps;
}

TEST_F(FoundProgram, AxisJerkOnAHelixOfATenthOfAMillimetreIsPlannedToItsEnd) {
  request.machine.limits.axis_jerk = {30000.0, 30000.0, 0.0};
  const auto points = follow(
      "G1 F3000\nG1 X0.0721 Y0.1384 Z0.0515\nG2 I0.1171 Z-0.4798\nG64 P0.041760\nG4 P0.0105\n"
      "G1 X0.0723 Y0.1383 Z-0.4798\nG0 X0.3614 Y-0.4107 Z-0.3352\nG1 X0.3628 Y-0.4103 Z-0.3352\n");
  // The jerk v^3 / r^2 of the helix bounds its feedrate, and the time that its length takes.
  const double radius = 0.1171;
  const double fastest = std::cbrt(30000.0 * radius * radius);
  ASSERT_GT(static_cast<double>(points.size()) * period(),
            2.0 * std::numbers::pi * radius / fastest);
  EXPECT_LT(points.size(), 400U);
  EXPECT_LT((points.back().position - Vec3(0.3628, -0.4103, -0.3352)).norm(), 1e-6);
}

TEST_F(FoundProgram, NothingButSpecksIsARestAtTheStart) {
  const auto points = follow("G1 F3000\nG1 X-0.000001\nG1 X0\nM30\n");
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points.front().feedrate, 0.0);
  EXPECT_EQ(points.back().feedrate, 0.0);
  EXPECT_EQ(points.back().position, Vec3(Vec3::Zero()));
}

TEST_F(FoundProgram, AKinkOfAThousandthOfADegreeBetweenTwoNurbsIsNoStop) {
  const std::string first =
      "G21 G90 G94 F3000\nG6.2 P4 K0 X0 Y0 R1\nK0 X10 Y0 R1\nK0 X20 Y10 R1\nK0 X30 Y10 R1\nK1\nK1\n"
      "K1\nK1\n";
  for (const std::string y : {"10", "10.001"}) {
    const auto points = follow(first + "G6.2 P4 K0 X30 Y10 R1\nK0 X40 Y" + y +
                               " R1\nK0 X50 Y0 R1\nK0 X60 Y0 R1\nK1\nK1\nK1\nK1\nM30\n");
    const auto steps = steps_of(points);
    ASSERT_GT(steps.size(), 400U);
    for (std::size_t i = 200; i + 200 < steps.size(); ++i) {
      ASSERT_GT(steps[i].norm() / period(), 49.0) << y << " at " << i;
    }
  }
}

TEST_F(FoundProgram, ThePapersPlannerDoesNotHideTurnsBackWithinAPeriod) {
  request.machine.path.planner = Planner::kPaper;
  std::string text = "G1 F3000\n";
  for (int i = 0; i < 12; ++i) {
    text += "G1 X-0.001\nG1 X0\n";
  }
  const auto steps = steps_of(follow(text + "G1 X0.126\nM30\n"));
  const Limits& limits = request.machine.limits;
  // On the straight end of the path nothing but the tangential jerk is there.
  std::size_t last_back = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    last_back = steps[i].dot(steps[i - 1]) < 0.0 ? i : last_back;
  }
  const double t3 = std::pow(period(), 3);
  for (std::size_t i = last_back + 3; i < steps.size(); ++i) {
    const double jerk = (steps[i].norm() - 2.0 * steps[i - 1].norm() + steps[i - 2].norm()) / t3;
    ASSERT_LE(std::abs(jerk), 1.01 * limits.jerk) << "period " << i;
  }
}

TEST_F(FoundProgram, ZigzagsOfMicrometresKeepTheNormalAccelerationWhereTheJerkIsLarge) {
  request.machine.limits.acceleration = 300.0;
  request.machine.limits.jerk = 1e6;
  std::string text = "G1 F3000\nG1 X-0.003 Y-0.003\n";
  for (int i = 0; i < 26; ++i) {
    text += "G1 X" + std::to_string(0.003 + 0.006 * i) + (i % 2 == 0 ? " Y-0.009\n" : " Y-0.003\n");
  }
  const auto steps = steps_of(follow(text + "M30\n"));
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Vec3 change = (steps[i] - steps[i - 1]) / (period() * period());
    const Vec3 way = steps[i] + steps[i - 1];
    if (way.norm() > 0.0) {
      const Vec3 normal = change - change.dot(way) / way.squaredNorm() * way;
      ASSERT_LE(normal.norm(), 1.01 * 300.0) << "period " << i;
    }
  }
}

}  // namespace found_programs_test
}  // namespace twin::runtime
