#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "hal/ideal/ideal_machine.hpp"
#include "runtime/set_points.hpp"
#include "tests/runtime/run_fixture.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/way_between.hpp"

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

/// Largest jerk along the path where set points lie on one line or circle [mm/s^3].
double largest_jerk(const std::vector<Vec3>& places, double period) {
  constexpr double kOff = 1e-9;  // distance from a line or circle that counts as none [mm]
  double largest = 0.0;
  for (std::size_t i = 6; i <= places.size(); ++i) {
    const std::span<const Vec3, 6> around(&places[i - 6], 6);
    if (const auto s = test::lengths_between(around, kOff)) {
      const double third = (*s)[2] - 2.0 * (*s)[1] + (*s)[0];
      largest = std::max(largest, std::abs(third) / std::pow(period, 3));
    }
  }
  return largest;
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

// Passages on legs of 1.3 mm have feedrates of their own, and were compared with the corner at those: under
// the limits of axes the chain took 2.24 s with them, and 1.93 s without.
TEST_F(FoundProgram, PassagesOnShortLegsAreTakenOnlyWhereTheyAreQuicker) {
  request.machine.limits.acceleration = 3837.0;
  request.machine.limits.axis_acceleration = {2183.0, 980.6, 1347.6};
  request.machine.limits.axis_jerk = {50356.0, 18437.0, 23704.0};
  request.machine.planning.corner_error = 1e-4;
  request.machine.period = 0.004;
  std::string text = "G1 F4862.8\n";
  double x = 0.0;
  double y = 0.0;
  for (int i = 0; i < 17; ++i) {
    const double heading = -0.051 * (2 * i + 1);
    x += 1.317 * std::cos(heading);
    y += 1.317 * std::sin(heading);
    text += fmt::format("X{:.6f} Y{:.6f}\n", x, y);
  }
  const std::size_t with = follow(text).size();
  request.machine.path.corners = CornerKind::kCurve;
  EXPECT_LE(with, follow(text).size() + 1);
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

TEST_F(FoundProgram, TurnsBackATenthOfAMicrometreApartKeepTheJerk) {
  request.machine.path.planner = Planner::kPaper;
  request.machine.limits.acceleration = 555996.0;
  request.machine.period = 0.25e-3;
  std::string text = "G1 F240\n";
  for (int i = 0; i < 6; ++i) {
    text += fmt::format("G1 X{:.6f} Y{:.6f}\nG1 X{:.6f}\n", -8.8e-5 + 1.5e-5 * i, 5.3e-5 * (i + 1),
                        1.5e-5 * (i + 1));
  }
  std::vector<Vec3> places;
  for (const auto& point : follow(text + "G1 X-0.016420\nG1 X0.000090\nM30\n")) {
    places.push_back(point.position);
  }
  EXPECT_LE(largest_jerk(places, period()), 1.01 * request.machine.limits.jerk);
}

TEST_F(FoundProgram, ACornerKeepsTheAccelerationWhereTheJerkReachesItWithinAPeriod) {
  request.machine.path.planner = Planner::kPaper;
  request.machine.limits.acceleration = 245.0;
  request.machine.limits.jerk = 26348571.0;
  request.machine.period = 0.5e-3;
  for (const char* end : {"Y0.001", "X0 Y0.0005", "X0 Y0.00001"}) {
    const auto steps =
        steps_of(follow(std::string("G1 F240\nG1 X0.001026\nG1 ") + end + "\nM30\n"));
    for (std::size_t i = 1; i < steps.size(); ++i) {
      const double acceleration = (steps[i] - steps[i - 1]).norm() / (period() * period());
      ASSERT_LE(acceleration, 1.02 * std::sqrt(2.0) * 245.0) << end << ", period " << i;
      const Vec3 way = steps[i] + steps[i - 1];
      const double normal = 2.0 * steps[i - 1].cross(steps[i]).norm() / way.norm();
      ASSERT_LE(way.norm() > 0.0 ? normal : 0.0, 1.02 * 245.0 * period() * period())
          << end << ", period " << i;
    }
  }
}

TEST_F(FoundProgram, SegmentsShorterThanAPeriodOfTheLargestFeedrateDoNotStopAMotionInRealTime) {
  hal::ideal::IdealMachine machine;
  request.machine.path.planner = Planner::kPaper;
  request.machine.path.look_ahead = 4;
  request.is_wall_clock = true;
  request.machine.realtime.priority = 0;
  request.machine.realtime.max_late_periods = 1000000;  // however busy the computer is
  request.machine.realtime.max_stall = 100.0;
  std::string text = "G1 F3000 X0.5\n";
  for (int i = 1; i <= 60; ++i) {
    text += fmt::format("G1 X{:.6f} Y{:.6f}\n", 0.5 + 4e-5 * (i / 2), 4e-5 * ((i + 1) / 2));
  }
  request.program = test::text_of(folder.put("crawl.nc", text + "G1 X0.6 Y0.05\n"));
  request.overrides = {{0.01, 60.0}, {0.1, 100.0}};
  request.is_wall_clock = false;
  const auto lockstep = run(&machine);
  request.is_wall_clock = true;
  request.directory = folder / "wall_clock";
  const auto wall_clock = run(&machine);
  ASSERT_TRUE(lockstep && wall_clock && !wall_clock->failure);
  EXPECT_LT(wall_clock->summary.run->machining_time,
            2.0 * lockstep->summary.run->machining_time + 0.3);
}

}  // namespace found_programs_test
}  // namespace twin::runtime
