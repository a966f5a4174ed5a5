#include "runtime/set_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "hal/ideal/ideal_machine.hpp"
#include "tests/runtime/run_fixture.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/trace_rows.hpp"

// Set points one by one, for a loop of one's own: the same ones that a run has.
namespace twin::runtime {
namespace set_points_test {

const std::string kProgram = "G01 X40 F3000\nG03 X60 Y20 R20\nG01 Y60\nX0 Y0\n";

/// Follows a program to its end; `each` is called before every set point.
template <class Each>
std::vector<motion::SetPoint> follow(SetPoints& points, const Each& each) {
  std::vector<motion::SetPoint> all;
  motion::SetPoint point;
  each(points);
  while (points.next(point)) {
    all.push_back(point);
    each(points);
  }
  return all;
}

std::vector<double> way_of(const std::vector<motion::SetPoint>& points) {
  std::vector<double> way{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    way.push_back(way.back() + (points[i].position - points[i - 1].position).norm());
  }
  return way;
}

/// Set points one by one against those of a run.
class SetPointsOfARun : public RunProgram {
 protected:
  void expect_same(const std::string& text) {
    request.program = gcode::ProgramText::from_text(text, "text");
    MemoryTrace trace;
    request.sinks = {&trace};
    hal::ideal::IdealMachine machine;
    const auto result = run(&machine);
    ASSERT_TRUE(result && !result->failure);
    EXPECT_EQ(result->summary.program, "text");
    auto points = SetPoints::open(request.program, request.machine);
    ASSERT_TRUE(points);
    const auto all = follow(*points, [](SetPoints&) {});
    ASSERT_EQ(all.size(), trace.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(all[i].position.x(), trace["x_cmd_mm"][i]);
      ASSERT_EQ(all[i].position.y(), trace["y_cmd_mm"][i]);
      ASSERT_EQ(all[i].feedrate, trace["feedrate_mm_per_s"][i]);
      ASSERT_EQ(static_cast<double>(all[i].line), trace["line"][i]);
    }
    EXPECT_FALSE(points->error());
  }
};

TEST_F(SetPointsOfARun, AreTheSame) { expect_same(kProgram); }

TEST_F(SetPointsOfARun, AreTheSameWhereTheRunPlansALongProgramAgain) {
  request.machine.path.planner = Planner::kPaper;
  std::string text = "G61 G01 F3000\n";
  for (int i = 0; i < 600; ++i) {
    text += i % 2 == 0 ? "X1\nY1\n" : "X0\nY0\n";
  }
  expect_same(text);
}

TEST(SetPoints, FollowOverrideAndHoldWithinTheLimits) {
  const config::MachineFile machine;
  const std::string smooth = "G01 X40 F3000\nG03 X60 Y20 R20\nG01 Y100\n";
  auto points = SetPoints::open(gcode::ProgramText::from_text(smooth, "text"), machine);
  ASSERT_TRUE(points);
  int rests = 0;
  const auto all = follow(*points, [&](SetPoints& now) {
    const double t = now.time();
    now.set_override(t < 0.5 ? 100.0 : 40.0);
    now.hold(t >= 1.0 && t < 1.5);
  });
  for (const motion::SetPoint& point : all) {
    rests += point.feedrate == 0.0 ? 1 : 0;
  }
  EXPECT_GT(rests, 300);  // of the 500 periods of the hold
  EXPECT_LT((all.back().position - Vec3(60.0, 100.0, 0.0)).norm(), 1e-9);
  EXPECT_EQ(points->overrides().size(), 3U);
  test::expect_within_limits(way_of(all), machine.period, machine.limits, 50.0, 0.5);
}

TEST(SetPoints, BrakeOnThePathWhereTheProgramIsWrong) {
  std::string text = "G61 G01 F3000\n";
  for (int i = 0; i < 200; ++i) {
    text += "X5\nY5\nX0\nY0\n";
  }
  auto points = SetPoints::open(gcode::ProgramText::from_text(text + "Q1\n", "text"), {});
  ASSERT_TRUE(points);
  const auto all = follow(*points, [](SetPoints&) {});
  ASSERT_TRUE(points->error());
  EXPECT_EQ(points->error()->line, 802);
  ASSERT_GT(all.size(), 1000U);
  EXPECT_EQ(all.back().feedrate, 0.0);
  for (std::size_t i = 1; i < all.size(); ++i) {
    ASSERT_LT(std::abs(all[i].feedrate - all[i - 1].feedrate),
              1.001 * Limits{}.acceleration * config::MachineFile{}.period);
  }
}

TEST_F(RunProgram, AProgramAsTextIsTheProgramOfTheFile) {
  MemoryTrace of_file;
  MemoryTrace of_text;
  hal::ideal::IdealMachine machine;
  request.program = test::text_of(folder.put("part.nc", kProgram));
  request.sinks = {&of_file};
  ASSERT_TRUE(run(&machine));
  request.program = gcode::ProgramText::from_text(kProgram, "part.nc");
  request.sinks = {&of_text};
  ASSERT_TRUE(run(&machine));
  ASSERT_EQ(of_file.size(), of_text.size());
  for (const TraceColumn& column : of_file.header().columns) {
    const auto a = of_file[column.name];
    const auto b = of_text[column.name];
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin())) << column.name;
  }
}

TEST_F(RunProgram, AFaultOfATextHasItsNameAndLine) {
  request.program = gcode::ProgramText::from_text("G01 X10 F600\nX201\n", "made up");
  const auto result = run(nullptr);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().file, "made up");
  EXPECT_EQ(result.error().line, 2);
}

}  // namespace set_points_test
}  // namespace twin::runtime
