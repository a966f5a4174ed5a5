#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"
#include "twin/twin.hpp"

namespace twin {
namespace run_test {

const char* const kTriangle = "G21 G90 G64\nG1 X20 F3000\nY15\nX0 Y0\nM30\n";

/// The fields of a CSV file's rows, column after column.
std::vector<std::vector<double>> columns_of(const std::string& csv, std::size_t count) {
  std::vector<std::vector<double>> columns(count);
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string field;
    for (std::vector<double>& column : columns) {
      std::getline(fields, field, ',');
      column.push_back(std::stod(field));
    }
  }
  return columns;
}

TEST(Run, TheTraceIsByteForByteThatOfTheCommand) {
  const test::TempFolder folder;
  const auto command = test::run_twin(
      {"run", "circle.nc", "--no-plots", "--quiet", "--out", (folder / "command").string()},
      {.directory = folder.path(), .largest_file = {}});
  ASSERT_EQ(command.status, 0) << command.err;
  MemoryTrace memory;
  CsvTrace csv((folder / "sink").string());
  const Settings settings;
  const twin::Run result = run(Program::from_file("circle.nc"), settings, *make_table(settings),
                               {.sinks = {&memory, &csv}, .folder = (folder / "files").string()});
  ASSERT_FALSE(result.failure) << to_string(*result.failure);
  const std::string expected = test::content(folder / "command" / "trace.csv");
  EXPECT_GT(expected.size(), 100000U);
  EXPECT_TRUE(test::content(folder / "sink" / "trace.csv") == expected);
  EXPECT_TRUE(test::content(folder / "files" / "trace.csv") == expected);
  EXPECT_EQ(test::content(folder / "files" / "summary.json"), result.summary.json());

  ASSERT_EQ(memory.header().columns.size(), 16U);
  const auto columns = columns_of(expected, memory.header().columns.size());
  ASSERT_EQ(memory.size(), columns.front().size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto column = memory[memory.header().columns[i].name];
    EXPECT_TRUE(std::equal(column.begin(), column.end(), columns[i].begin())) << i;
  }
  EXPECT_TRUE(memory.is_complete());
}

TEST(Run, ManyAtOnceAreEachAsIfAlone) {
  const Program program = Program::from_text(kTriangle);
  const auto x_table = [&](double gain) {
    Settings settings;
    settings.set("servo.x.kp_per_s", gain);
    MemoryTrace trace;
    const twin::Run result = run(program, settings, *make_table(settings), {.sinks = {&trace}});
    EXPECT_FALSE(result.failure);
    const auto column = trace["x_table_mm"];
    return std::vector<double>(column.begin(), column.end());
  };
  const std::vector<double> gains{60.0, 80.0, 100.0, 120.0};
  std::vector<std::vector<double>> together(gains.size());
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < gains.size(); ++i) {
      threads.emplace_back([&, i] { together[i] = x_table(gains[i]); });
    }
  }
  for (std::size_t i = 0; i < gains.size(); ++i) {
    EXPECT_TRUE(together[i] == x_table(gains[i])) << gains[i];
  }
  EXPECT_FALSE(together.front() == together.back());
}

TEST(Run, TheSummaryHasItsFiguresByName) {
  const twin::Run result =
      run(Program::from_text(kTriangle, "triangle.nc"), Settings(), *make_ideal());
  const Summary& summary = result.summary;
  EXPECT_EQ(summary.text("program"), "triangle.nc");
  EXPECT_EQ(summary.text("hal"), "ideal");
  EXPECT_EQ(summary.text("simulated"), "true");
  EXPECT_TRUE(summary.has("audit.axis.x.jerk_mm_per_s3"));
  EXPECT_FALSE(summary.has("audit"));
  EXPECT_THAT(summary.keys(), testing::Contains("contour_error_um.max"));
  EXPECT_THAT(summary.table(), testing::HasSubstr("contour error"));
  EXPECT_THROW(summary.number("program"), Failure);
  try {
    summary.number("contour_error_um.mux");
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), testing::HasSubstr("did you mean contour_error_um.max?"));
  }
}

TEST(Run, OverridesAtTimesChangeTheTime) {
  const Program program = Program::from_text("G21 G90\nG1 X60 F1800\nM30\n");
  const auto time = [&](std::vector<OverrideChange> overrides) {
    return run(program, Settings(), *make_ideal(), {.overrides = std::move(overrides)})
        .summary.number("machining_time_s");
  };
  EXPECT_GT(time({{0.0, 50.0}}), 1.8 * time({}));
}

TEST(Run, TheOperatorMayStopItOnThePath) {
  Panel panel;
  const std::jthread person([&panel] {
    while (panel.display().state != Panel::State::kMoving) {
      std::this_thread::yield();
    }
    panel.stop();
  });
  MemoryTrace trace;
  const twin::Run result =
      run(Program::from_text("G21 G90\nG1 X60 F60\nM30\n"), Settings(), *make_ideal(),
          {.sinks = {&trace}, .is_wall_clock = true, .panel = &panel});
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, ErrorCode::kInterrupted);
  EXPECT_GT(trace.size(), 0U);
  EXPECT_FALSE(trace.is_complete());
}

TEST(Run, AStopBeforeItBeginsIsAFailureAndNothingMoves) {
  Panel panel;
  panel.stop();
  MemoryTrace trace;
  try {
    run(Program::from_text(kTriangle), Settings(), *make_ideal(),
        {.sinks = {&trace}, .panel = &panel});
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().code, ErrorCode::kInterrupted);
  }
  EXPECT_EQ(trace.size(), 0U);
}

/// A sink that takes a number of rows and then fails.
class FullSink final : public TraceSink {
 public:
  std::optional<Error> begin(const TraceHeader& header) override {
    columns_ = header.columns.size();
    return std::nullopt;
  }
  std::optional<Error> rows(std::span<const double> values) override {
    taken_ += values.size() / columns_;
    return taken_ < 100 ? std::nullopt
                        : std::optional(Error{ErrorCode::kFile, "is full", "sink", 0, 0});
  }
  std::optional<Error> commit() override { return std::nullopt; }
  void abandon() noexcept override { is_abandoned = true; }

  bool is_abandoned = false;

 private:
  std::size_t columns_ = 1;
  std::size_t taken_ = 0;
};

TEST(Run, ASinkThatFailsEndsIt) {
  FullSink sink;
  const twin::Run result =
      run(Program::from_text(kTriangle), Settings(), *make_ideal(), {.sinks = {&sink}});
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(to_string(*result.failure), "sink: is full");
  EXPECT_TRUE(sink.is_abandoned);
}

/// Drives that are where they are told to be, or refuse to start.
class OwnMachine final : public Machine {
 public:
  explicit OwnMachine(bool has_power) : has_power_(has_power) {
    info_.name = "own";
    info_.follows_reference = true;
    info_.mm_per_count = {0.001, 0.001};
    info_.mm_per_s_per_volt = {50.0, 50.0};
  }
  const MachineInfo& info() const noexcept override { return info_; }
  std::optional<Error> configure(double) override {
    return has_power_ ? std::nullopt
                      : std::optional(Error{ErrorCode::kMachine, "the power is off", {}, 0, 0});
  }
  std::optional<Error> activate() override { return std::nullopt; }
  MachineStatus read(Inputs& inputs) noexcept override {
    inputs.servo_ready = {true, true};
    return MachineStatus::kOk;
  }
  MachineStatus write(const Outputs& outputs) noexcept override {
    truth_ = {{outputs.position_reference[0], outputs.position_reference[1]}};
    return MachineStatus::kOk;
  }
  Truth truth() const noexcept override { return truth_; }
  void deactivate() noexcept override { ++deactivated; }
  void cleanup() noexcept override {}
  std::string last_error() const override { return {}; }

  int deactivated = 0;

 private:
  bool has_power_;
  MachineInfo info_;
  Truth truth_;
};

TEST(Run, AMachineOfOnesOwnIsDrivenAndSwitchedOff) {
  OwnMachine machine(true);
  const twin::Run result = run(Program::from_text(kTriangle), Settings(), machine);
  EXPECT_FALSE(result.failure);
  EXPECT_EQ(result.summary.text("hal"), "own");
  EXPECT_EQ(result.summary.number("tracking_error_um.x.max"), 0.0);
  EXPECT_GE(machine.deactivated, 1);
}

TEST(Run, AMachineThatRefusesIsAFailureBeforeAnythingMoves) {
  OwnMachine machine(false);
  try {
    run(Program::from_text(kTriangle), Settings(), machine);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().code, ErrorCode::kMachine);
    EXPECT_STREQ(failure.what(), "the power is off");
  }
}

/// Proportional position loops, until they give nothing any more.
class ProportionalServo final : public Servo {
 public:
  std::optional<std::array<double, kServoAxes>> volts(
      const SetPoint& point, const std::array<double, kServoAxes>& measured) noexcept override {
    if (++calls == most_calls) {
      return std::nullopt;
    }
    largest_error = std::max(largest_error, std::abs(point.position[0] - measured[0]));
    return std::array{(point.position[0] - measured[0]) * 2.0,
                      (point.position[1] - measured[1]) * 2.0};
  }
  int calls = 0;
  int most_calls = 0;
  double largest_error = 0.0;  // [mm]
};

TEST(Run, AServoOfOnesOwnClosesTheLoops) {
  const Settings settings = Settings().set("safety.tracking_error_mm=20");
  ProportionalServo servo;
  const twin::Run result =
      run(Program::from_text(kTriangle), settings, *make_table(settings), {.servo = &servo});
  ASSERT_FALSE(result.failure) << to_string(*result.failure);
  EXPECT_GT(servo.calls, 1000);
  EXPECT_NEAR(result.summary.number("tracking_error_um.x.max"), 1000.0 * servo.largest_error, 1.0);
}

TEST(Run, AServoWithoutAnAnswerSwitchesTheMachineOff) {
  const Settings settings;
  ProportionalServo servo;
  servo.most_calls = 305;
  const twin::Run result =
      run(Program::from_text(kTriangle), settings, *make_table(settings), {.servo = &servo});
  ASSERT_TRUE(result.failure);
  EXPECT_THAT(result.failure->message, ::testing::HasSubstr("the servo gave no drive command"));
  EXPECT_EQ(servo.calls, 305);
}

TEST(Run, AFaultOfTheEmulatedRigIsItsFailure) {
  const Settings settings;
  const Program program = Program::from_text("G21 G90\nG1 X60 F600\nM30\n");
  const auto rig = make_emulated_rig(settings, {"alarm:x@1.5"});
  const twin::Run result = run(program, settings, *rig);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, ErrorCode::kMachine);
  EXPECT_THAT(to_string(*result.failure), testing::HasSubstr("alarm"));
  EXPECT_THROW(make_emulated_rig(settings, {"nonsense@1"}), Failure);
}

}  // namespace run_test
}  // namespace twin
