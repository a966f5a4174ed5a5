#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "tests/support/temp_folder.hpp"
#include "twin/twin.hpp"

namespace twin {
namespace api_test {

const char* const kTriangle = "G21 G90 G64\nG1 X20 F3000\nY15\nX0 Y0\nM30\n";

/// The error that a call throws.
Error failure_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.what(), to_string(failure.error()));
    return failure.error();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Program, ATextIsCheckedAgainstTheTravel) {
  const Program program = Program::from_text(kTriangle, "parts/triangle.nc");
  EXPECT_EQ(program.name(), "triangle.nc");
  const ProgramFigures figures = program.check(Settings());
  EXPECT_EQ(figures.blocks, 3);
  EXPECT_DOUBLE_EQ(figures.length, 20.0 + 15.0 + 25.0);
  EXPECT_EQ(figures.box_max, (std::array{20.0, 15.0, 0.0}));
}

TEST(Program, WhatIsWrongHasFileLineAndColumn) {
  const Program program = Program::from_text("G21 G90\nG1 X1 F100\nG1 X2 Q5\n", "part.nc");
  const auto is_told = [&](const std::function<void()>& call) {
    const Error error = failure_of(call);
    EXPECT_EQ(error.code, ErrorCode::kProgram);
    EXPECT_EQ(error.file, "part.nc");
    EXPECT_EQ(error.line, 3);
    EXPECT_EQ(error.column, 7);
  };
  is_told([&] { program.check(Settings()); });
  is_told([&] { plan(program, Settings()); });
  is_told([&] { run(program, Settings(), *make_ideal()); });
  is_told([&] {
    Interpolator interpolator(program, Settings());
    while (interpolator.next()) {
    }
  });
}

TEST(Program, AFileThatIsMissingIsNamedWithTheNearestOne) {
  const Error error = failure_of([] { Program::from_file("crcle.nc"); });
  EXPECT_EQ(error.code, ErrorCode::kFile);
  EXPECT_THAT(to_string(error), testing::HasSubstr("did you mean circle.nc?"));
}

TEST(Program, AFeedrateTakesThePlaceOfItsWords) {
  const Program without = Program::from_text("G21 G90\nG1 X20\nM30\n");
  Settings none;
  none.set("program.default_feedrate=0");
  EXPECT_EQ(failure_of([&] { plan(without, none); }).line, 2);
  const double slow = plan(without.with_feedrate(10.0), Settings()).time();
  const double fast = plan(without.with_feedrate(40.0), Settings()).time();
  EXPECT_GT(slow, 2.0);
  EXPECT_LT(fast, slow / 2.0);
  EXPECT_EQ(failure_of([&] { without.with_feedrate(0.0); }).code, ErrorCode::kUsage);
}

TEST(Settings, ASettingIsReadBackAsItWasSet) {
  Settings settings;
  settings.set("servo.x.kp_per_s=300").set("limits.jerk", 20000.0);
  EXPECT_EQ(settings.number("servo.x.kp"), 300.0);
  EXPECT_EQ(settings.number("limits.jerk_mm_per_s3"), 20000.0);
  EXPECT_EQ(settings.text("planning.planner"), "certified");
  EXPECT_EQ(settings.name(), "xy_table");
  EXPECT_THAT(settings.keys(), testing::Contains("limits.jerk_mm_per_s3"));
  EXPECT_THAT(settings.toml(), testing::HasSubstr("jerk_mm_per_s3 = 20000"));
}

TEST(Settings, ACopyIsIndependent) {
  Settings settings;
  const double before = settings.number("limits.jerk");
  Settings other = settings;
  other.set("limits.jerk", before / 2.0);
  EXPECT_EQ(settings.number("limits.jerk"), before);
  settings = other;
  EXPECT_EQ(settings.number("limits.jerk"), before / 2.0);
}

TEST(Settings, AWrongOneIsRefusedAndNothingChanges) {
  Settings settings;
  const std::string before = settings.toml();
  EXPECT_THAT(to_string(failure_of([&] { settings.set("limits.jrk", 1.0); })),
              testing::AllOf(testing::StartsWith("limits.jrk=1: unknown key"),
                             testing::HasSubstr("did you mean limits.jerk")));
  EXPECT_EQ(failure_of([&] { settings.set("limits.jerk=-1"); }).code, ErrorCode::kUsage);
  EXPECT_EQ(failure_of([&] { settings.number("limits.jrk"); }).code, ErrorCode::kUsage);
  EXPECT_THAT(to_string(failure_of([&] { settings.number("planning.planner"); })),
              testing::HasSubstr("is no number"));
  EXPECT_EQ(settings.toml(), before);
}

TEST(Plan, ItsTimeIsThatOfTheSummary) {
  const Program program = Program::from_text(kTriangle);
  const Plan planned = plan(program, Settings());
  const twin::Run ideal = run(program, Settings(), *make_ideal());
  EXPECT_NEAR(planned.time(), ideal.summary.number("planned_time_s"), 1e-8);
  EXPECT_NEAR(planned.path_length(), ideal.summary.number("path_length_mm"), 1e-6);
  EXPECT_EQ(planned.blocks(), 3);
  EXPECT_EQ(planned.segments(), static_cast<std::int64_t>(ideal.summary.number("segments.total")));
  EXPECT_GT(planned.certified_deviation(), 0.0);
  const double bound = planned.bound();
  EXPECT_GT(bound, 0.0);
  EXPECT_LE(bound, planned.time());
}

TEST(Interpolator, ItsSetPointsAreThoseOfARun) {
  const Program program = Program::from_file("circle.nc");
  MemoryTrace trace;
  run(program, Settings(), *make_ideal(), {.sinks = {&trace}});
  Interpolator interpolator(program, Settings());
  EXPECT_EQ(interpolator.period(), trace.header().period);
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const auto point = interpolator.next();
    ASSERT_TRUE(point) << i;
    ASSERT_EQ(point->time, trace["t_s"][i]);
    ASSERT_EQ(point->position[0], trace["x_cmd_mm"][i]);
    ASSERT_EQ(point->position[1], trace["y_cmd_mm"][i]);
    ASSERT_EQ(point->feedrate, trace["feedrate_mm_per_s"][i]);
    ASSERT_EQ(static_cast<double>(point->line), trace["line"][i]);
  }
  EXPECT_FALSE(interpolator.next());
  EXPECT_FALSE(interpolator.next());
}

TEST(Interpolator, AHoldStandsOnThePathUntilItIsResumed) {
  Interpolator interpolator(Program::from_text(kTriangle), Settings());
  const auto after = [&](int periods) {
    std::optional<SetPoint> point;
    for (int i = 0; i < periods; ++i) {
      point = interpolator.next();
    }
    return point.value();
  };
  EXPECT_GT(after(200).feedrate, 1.0);
  interpolator.hold();
  const SetPoint first = after(500);
  EXPECT_EQ(first.feedrate, 0.0);
  EXPECT_EQ(after(100).position, first.position);
  interpolator.resume();
  SetPoint last = first;
  while (const auto point = interpolator.next()) {
    last = *point;
  }
  EXPECT_NEAR(last.position[0], 0.0, 1e-9);
  EXPECT_NEAR(last.position[1], 0.0, 1e-9);
}

TEST(Interpolator, AnOverrideScalesTheFeedrateFromAPlaceAhead) {
  Interpolator interpolator(Program::from_text("G21 G90\nG1 X60 F1200\nM30\n"), Settings());
  interpolator.set_override(50.0);
  double first = 0.0;   // largest feedrate of the first second [mm/s]
  double second = 0.0;  // of the next [mm/s]
  while (const auto point = interpolator.next()) {
    double& largest = point->time < 1.0 ? first : second;
    largest = std::max(largest, point->feedrate);
  }
  EXPECT_LE(first, 20.0 + 1e-9);
  EXPECT_NEAR(second, 10.0, 1e-6);
}

TEST(Identify, ATraceThatIsMissingIsNamed) {
  const Error error = failure_of([] { identify({"none.csv"}, Settings()); });
  EXPECT_EQ(error.code, ErrorCode::kFile);
  EXPECT_THAT(to_string(error), testing::HasSubstr("none.csv"));
}

TEST(Identify, ATraceToValidateWithThatIsMissingIsNamed) {
  const test::TempFolder folder;
  std::string trace = "t_s,x_ref_mm,x_enc_mm\n";
  for (int k = 0; k < 1000; ++k) {
    const double x = 10.0 - 10.0 * std::cos(6e-3 * k);
    trace += std::to_string(1e-3 * k) + "," + std::to_string(x) + "," +
             std::to_string(0.01 * std::floor(100.0 * x)) + "\n";
  }
  IdentifyOptions options{.columns = "t=t_s,x_cmd=x_ref_mm,x_meas=x_enc_mm", .evaluations = 1};
  const std::string file = folder.put("trace.csv", trace).string();
  options.validating = {file};
  const Identification found = identify({file}, Settings(), options);
  ASSERT_EQ(found.validations.size(), 1U);
  EXPECT_EQ(found.validations[0].axis, "x");
  EXPECT_FALSE(found.validations[0].is_held_out);
  EXPECT_GT(found.validations[0].tracking_rms, 0.0);
  EXPECT_LT(found.validations[0].force_error, 0.0);
  options.validating = {"none.csv"};
  EXPECT_EQ(failure_of([&] { identify({file}, Settings(), options); }).file, "none.csv");
}

TEST(Identify, AKeyThatNoTraceShowsIsRefusedWithTheNearestOne) {
  const auto refusal = [](const IdentifyOptions& options) {
    return failure_of([&] { identify({"none.csv"}, Settings(), options); });
  };
  const Error fixed = refusal({.fixed = {"table.x.movin_mass"}});
  EXPECT_EQ(fixed.code, ErrorCode::kUsage);
  EXPECT_THAT(fixed.message, testing::StartsWith("table.x.movin_mass is nothing that a trace"));
  EXPECT_THAT(fixed.message, testing::HasSubstr("did you mean table.x.moving_mass_kg?"));
  EXPECT_EQ(refusal({.freed = {"limits.jerk"}}).code, ErrorCode::kUsage);
  const Error known = refusal({.fixed = {"table.x.moving_mass"}, .freed = {"servo.y.kp_per_s"}});
  EXPECT_EQ(known.file, "none.csv");
}

}  // namespace api_test
}  // namespace twin
