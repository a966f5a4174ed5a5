#include "config/machine_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "config/binding.hpp"

namespace twin::config {
namespace machine_file_test {

using ::testing::HasSubstr;

MachineFile parsed(std::string_view text) {
  const auto machine = parse_machine_file(text, "/rigs/desk.toml");
  EXPECT_TRUE(machine) << to_string(machine.error());
  return machine.value_or(MachineFile{});
}

std::string refusal(std::string_view text) {
  const auto machine = parse_machine_file(text, "desk.toml");
  EXPECT_FALSE(machine) << text;
  if (machine) {
    return "";
  }
  EXPECT_EQ(machine.error().code, ErrorCode::kFile);
  return to_string(machine.error());
}

TEST(MachineFile, ValuesComeIntoBaseUnits) {
  const MachineFile m = parsed(R"(
    [limits]
    feedrate_mm_per_min = 6000
    acceleration_mm_per_s2 = 1000.5
    travel_min_mm = [-100, -90.5, -1]
    [interpolator]
    period_ms = 0.25
    [servo.y]
    ka_s = 0.002
    trim_V = -0.5
  )");
  EXPECT_DOUBLE_EQ(m.limits.feedrate, 100.0);
  EXPECT_DOUBLE_EQ(m.limits.acceleration, 1000.5);
  EXPECT_EQ(m.limits.travel_min, Vec3(-100.0, -90.5, -1.0));
  EXPECT_DOUBLE_EQ(m.period, 0.00025);
  EXPECT_DOUBLE_EQ(m.servo[hal::kY].ka, 0.002);
  EXPECT_DOUBLE_EQ(m.servo[hal::kY].trim_V, -0.5);
  EXPECT_DOUBLE_EQ(m.servo[hal::kX].ka, motion::Gains{}.ka);
  EXPECT_DOUBLE_EQ(m.limits.jerk, Limits{}.jerk);
  EXPECT_EQ(m.name, "desk");
}

TEST(MachineFile, UnitOfAKeyMayBeLeftOut) {
  const MachineFile m =
      parsed("[limits]\njerk = 7e4\nfeedrate = 600\n[interpolator]\nperiod = 4\n");
  EXPECT_DOUBLE_EQ(m.limits.jerk, 7e4);
  EXPECT_DOUBLE_EQ(m.limits.feedrate, 10.0);
  EXPECT_DOUBLE_EQ(m.period, 0.004);
}

TEST(MachineFile, ModelIsRelativeToTheMachineFile) {
  EXPECT_EQ(parsed("[table]\nmodel = \"../models/a.xml\"\n").table.model, "/models/a.xml");
  EXPECT_EQ(parsed("[table]\nmodel = \"/opt/b.xml\"\n").table.model, "/opt/b.xml");
  EXPECT_EQ(parsed("[table]\nmodel = \"none.xml\"").table.model, "/rigs/none.xml");
}

TEST(MachineFile, RefusalsNamePlaceValueUnitAndRange) {
  EXPECT_EQ(refusal("[limits]\n  jerk_mm_per_s3 = -5\n"),
            "desk.toml:2:20: limits.jerk_mm_per_s3 = -5 mm/s^3 is out of range: 1 to 1e+09 mm/s^3");
  EXPECT_EQ(refusal("[interpolator]\nperiod_ms = 10\n"),
            "desk.toml:2:13: interpolator.period_ms = 10 ms is out of range: 0.125 to 4 ms");
  EXPECT_THAT(refusal("[limits]\njerk = nan\n"),
              HasSubstr("limits.jerk_mm_per_s3 = nan is not a finite number"));
  EXPECT_THAT(refusal("[limits]\njerk = inf\n"), HasSubstr("is not a finite number"));
  EXPECT_THAT(refusal("[limits]\njerk = \"fast\"\n"), HasSubstr("= \"fast\" is not a number"));
  EXPECT_THAT(refusal("[planning]\nmax_segments = 2.5\n"), HasSubstr("2.5 is not a whole number"));
  EXPECT_THAT(refusal("[limits]\ntravel_min_mm = [1, 2]\n"), HasSubstr("[x, y, z]"));
  EXPECT_THAT(refusal("[limits]\ntravel_min_mm = [1, 2, nan]\n"), HasSubstr("finite"));
  EXPECT_THAT(refusal("[limits]\njerk = 1979-05-27\n"), HasSubstr("neither a number"));
  EXPECT_THAT(refusal("[table]\nmodel = 3\n"), HasSubstr("is not a text"));
}

TEST(MachineFile, ALimitThatKeepsAnAxisFromMovingIsRefused) {
  EXPECT_THAT(refusal("[limits]\naxis_jerk_mm_per_s3 = [1, 0.5, 0]\n"),
              HasSubstr("limits.axis_jerk_mm_per_s3 is 0.5 in y: expected 0, which is no limit of "
                        "its own, or at least 1"));
  EXPECT_THAT(refusal("[limits]\naxis_feedrate_mm_per_min = [0.25, 0, 0]\n"),
              HasSubstr("limits.axis_feedrate_mm_per_min is 0.25 in x"));
  EXPECT_THAT(refusal("[limits]\naxis_acceleration_mm_per_s2 = [9, 9, 1e-9]\n"),
              HasSubstr("limits.axis_acceleration_mm_per_s2 is 1e-09 in z"));
  EXPECT_EQ(parsed("[limits]\naxis_jerk_mm_per_s3 = [9, 1, 0]\n").limits.axis_jerk.y(), 1.0);
}

TEST(MachineFile, AnAxisWithoutALimitBesideOneThatHasOneIsRefused) {
  EXPECT_THAT(refusal("[limits]\naxis_jerk_mm_per_s3 = [0, 50000, 0]\n"),
              HasSubstr("limits.axis_jerk_mm_per_s3 is [0, 50000, 0], 0 in x, an axis that must "
                        "move: give it a limit of at least 1, or leave all three at 0"));
  EXPECT_THAT(refusal("[limits]\naxis_feedrate_mm_per_min = [600, 0, 600]\n"),
              HasSubstr("limits.axis_feedrate_mm_per_min is [600, 0, 600], 0 in y"));
  EXPECT_THAT(refusal("[limits]\naxis_acceleration_mm_per_s2 = [0, 0, 100]\n"),
              HasSubstr("limits.axis_acceleration_mm_per_s2 is [0, 0, 100], 0 in x"));
  EXPECT_EQ(parsed("[limits]\naxis_jerk_mm_per_s3 = [9, 8, 0]\n").limits.axis_jerk.z(), 0.0);
}

TEST(MachineFile, NoJerkIsRefused) {
  EXPECT_THAT(refusal("[limits]\njerk = 0\n"),
              HasSubstr("limits.jerk_mm_per_s3 = 0 mm/s^3 is out of range: 1 to 1e+09 mm/s^3"));
}

TEST(MachineFile, AToleranceBelowWhatCoordinatesResolveIsRefused) {
  EXPECT_THAT(refusal("[planning]\nchord_error = 1e-12\n"),
              HasSubstr("planning.chord_error_mm = 1e-12 mm is out of range: 1e-06 to 10 mm"));
}

TEST(MachineFile, UnknownNamesSuggestTheNearest) {
  EXPECT_EQ(refusal("[limits]\naccelration_mm_per_s2 = 1\n"),
            "desk.toml:2:1: unknown key accelration_mm_per_s2 in [limits]; did you mean "
            "acceleration_mm_per_s2?");
  EXPECT_THAT(refusal("[limit]\njerk = 1\n"),
              HasSubstr("unknown section [limit]; did you mean limits?"));
  EXPECT_THAT(refusal("[servo.z]\nkp = 1\n"),
              HasSubstr("unknown section [servo.z]; did you mean servo.x?"));
  EXPECT_THAT(refusal("jerk = 1\n"), HasSubstr("outside of any section"));
}

TEST(MachineFile, SyntaxErrorsHaveLineAndColumn) {
  EXPECT_THAT(refusal("[limits]\njerk = = 3\n"), HasSubstr("desk.toml:2:"));
  EXPECT_THAT(refusal("[limits\n"), HasSubstr("desk.toml:1:"));
  EXPECT_THAT(refusal("[limits]\njerk = 1\njerk = 2\n"), HasSubstr("desk.toml:3:"));
  EXPECT_THAT(refusal("\xff\xfe\x01"), HasSubstr("not valid TOML"));
}

TEST(MachineFile, AKeyGivenTwiceInBothFormsIsRefused) {
  EXPECT_THAT(refusal("[limits]\njerk = 1\njerk_mm_per_s3 = 2\n"), HasSubstr("given twice"));
}

TEST(MachineFile, AFormerKeyIsUnderstoodAndNoted) {
  const MachineFile m =
      parsed("[planning]\nplanner = \"paper\"\n[interpolator]\nkind = \"bezier\"\n");
  EXPECT_EQ(m.path.curves, CurveKind::kBezier);
  EXPECT_THAT(m.notes, ::testing::ElementsAre("interpolator.kind is now called path.curves"));
  EXPECT_THAT(to_toml(m), HasSubstr("[path]\ncurves = \"bezier\""));
  EXPECT_THAT(refusal("[path]\ncurves = \"nurbs\"\n[interpolator]\nkind = \"bezier\"\n"),
              HasSubstr("path.curves is given twice"));
}

TEST(MachineFile, ThePlannerThatPlansIsResolvedAndNoted) {
  const MachineFile m =
      parsed("[planning]\nplanner = \"certified\"\nacceleration_profile = \"fir\"\n");
  EXPECT_EQ(m.path.planner, Planner::kPaper);
  ASSERT_EQ(m.notes.size(), 1U);
  EXPECT_THAT(m.notes[0], HasSubstr("planning.planner = paper, because "
                                    "planning.acceleration_profile = fir"));
  EXPECT_EQ(parsed("").path.planner, Planner::kCertified);
  EXPECT_TRUE(parsed("").notes.empty());
}

TEST(MachineFile, ValuesThatDoNotFitTogetherAreRefused) {
  EXPECT_THAT(refusal("[limits]\ntravel_min_mm = [0, 300, 0]\n"), HasSubstr("in y"));
  EXPECT_THAT(refusal("[planning]\nmin_segments = 30\n"),
              HasSubstr("min_segments = 30 is more than"));
}

TEST(MachineFile, WhatIsWrittenReadsBackTheSame) {
  MachineFile m = parsed(
      "[limits]\nfeedrate = 1234.5678901\ntravel_max = [1.1, 2.2, 3.3]\n[servo.x]\nkp = 0.1\n");
  const std::string text = to_toml(m);
  const MachineFile again = parsed(text);
  EXPECT_EQ(to_toml(again), text);
  EXPECT_DOUBLE_EQ(again.limits.feedrate, m.limits.feedrate);
  EXPECT_DOUBLE_EQ(again.servo[0].kp, 0.1);
  EXPECT_THAT(text, HasSubstr("[limits]\nfeedrate_mm_per_min = 1234.5678901"));
}

TEST(MachineFile, DefaultsAreWithinTheirRangesAndKeysAreUnique) {
  MachineFile m;
  const std::string text = to_toml(m);
  EXPECT_TRUE(parse_machine_file(text, "a.toml")) << text;
  const auto list = bindings(m);
  for (const Binding& a : list) {
    for (const Binding& b : list) {
      EXPECT_TRUE(&a == &b || a.section != b.section ||
                  !(b.is_called(a.name) || b.is_called(a.key())))
          << a.path() << " and " << b.path();
    }
  }
}

TEST(MachineFile, UnitsAreWrittenAsEngineersDo) {
  EXPECT_EQ(pretty_unit("mm_per_s2"), "mm/s^2");
  EXPECT_EQ(pretty_unit("mm_per_min"), "mm/min");
  EXPECT_EQ(pretty_unit("per_s"), "1/s");
  EXPECT_EQ(pretty_unit("kg_m2"), "kg m^2");
  EXPECT_EQ(pretty_unit("N_s_per_m"), "N s/m");
  EXPECT_EQ(pretty_unit(""), "");
}

TEST(MachineFile, ShippedMachineFilesAreValidAndNameTheirModel) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TWIN_SOURCE_DIR "/mjcf")) {
    if (entry.path().extension() == ".toml") {
      const auto machine = read_machine_file(entry.path());
      ASSERT_TRUE(machine) << to_string(machine.error());
      EXPECT_TRUE(std::filesystem::exists(machine->table.model)) << machine->table.model;
      ++count;
    }
  }
  EXPECT_GE(count, 1);
}

TEST(MachineFile, FilesThatCannotBeReadAreRefused) {
  const auto message = [](const std::filesystem::path& file) {
    const auto machine = read_machine_file(file);
    EXPECT_FALSE(machine);
    return machine ? "" : to_string(machine.error());
  };
  const std::filesystem::path folder = testing::TempDir();
  EXPECT_THAT(message(folder / "no_such_file.toml"), HasSubstr("No such file"));
  EXPECT_THAT(message(folder), HasSubstr("is a directory"));
  const std::filesystem::path binary = folder / "binary.toml";
  std::ofstream(binary) << std::string("[limits]\0\0", 10);
  EXPECT_THAT(message(binary), HasSubstr("binary data"));
  std::filesystem::remove(binary);
}

TEST(MachineFile, ACopiedOneFindsTheModelInTheProgramsFolder) {
  const std::filesystem::path model = parsed("").table.model;  // /rigs has none
  EXPECT_TRUE(model.is_absolute());
  EXPECT_EQ(model.filename(), "xy_table.xml");
  EXPECT_TRUE(std::filesystem::exists(model)) << model;
}

}  // namespace machine_file_test
}  // namespace twin::config
