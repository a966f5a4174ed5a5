#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "results/trace/trace_reader.hpp"
#include "tests/runtime/run_fixture.hpp"
#include "tests/support/fake_machine.hpp"
#include "tests/support/program_text.hpp"

// The rows of a run go to any number of sinks; one that fails ends the run like any other fault.
namespace twin::runtime {
namespace trace_sinks_test {

using ::testing::HasSubstr;

/// A sink that fails at a call of its choice.
class FaultySink final : public TraceSink {
 public:
  enum class Fault { kNone, kBegin, kRows, kThrow, kCommit };
  explicit FaultySink(Fault fault) : fault_(fault) {}

  std::optional<Error> begin(const TraceHeader& /*header*/) override {
    return fail_at(Fault::kBegin);
  }
  std::optional<Error> rows(std::span<const double> /*values*/) override {
    if (fault_ == Fault::kThrow) {
      throw std::runtime_error("the sink is full");
    }
    return fail_at(Fault::kRows);
  }
  std::optional<Error> commit() override { return fail_at(Fault::kCommit); }
  void abandon() noexcept override { ++abandoned; }

  int abandoned = 0;

 private:
  std::optional<Error> fail_at(Fault fault) const {
    return fault == fault_ ? std::optional(Error{ErrorCode::kFile, "the sink is full", {}, 0, 0})
                           : std::nullopt;
  }
  Fault fault_;
};

std::size_t lines_of(const std::filesystem::path& file) {
  std::size_t lines = 0;
  EXPECT_TRUE(results::read_rows(file, std::array<std::string_view, 1>{"t_s"},
                                 [&](std::span<const double>) { ++lines; }));
  return lines;
}

TEST_F(RunProgram, MemoryHasTheNumbersOfTheFile) {
  MemoryTrace memory;
  request.sinks = {&memory};
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_TRUE(result && !result->failure);
  EXPECT_TRUE(memory.is_complete());
  std::vector<std::string_view> names;
  for (const TraceColumn& column : memory.header().columns) {
    names.push_back(column.name);
  }
  std::size_t row = 0;
  const auto read =
      results::read_rows(folder / "out/trace.csv", names, [&](std::span<const double> values) {
        for (std::size_t i = 0; i < names.size(); ++i) {
          ASSERT_EQ(memory[names[i]][row], values[i]) << names[i] << " in row " << row;
        }
        ++row;
      });
  EXPECT_TRUE(read);
  EXPECT_EQ(row, memory.size());
  EXPECT_EQ(names.size(), 16U);
}

TEST_F(RunProgram, WithoutAFolderNoFileIsWritten) {
  MemoryTrace memory;
  request.directory.clear();
  request.sinks = {&memory};
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_TRUE(result && !result->failure);
  EXPECT_GT(memory.size(), 100U);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  EXPECT_FALSE(std::filesystem::exists("plots"));
  EXPECT_FALSE(std::filesystem::exists("trace.csv"));
}

TEST_F(RunProgram, ASinkThatFailsBrakesTheMachineAndTheOthersKeepWhatWasRecorded) {
  for (const auto fault : {FaultySink::Fault::kRows, FaultySink::Fault::kThrow}) {
    request.program = test::text_of(folder.put("long.nc", "G01 X100 F3000\nX0\nX100\nX0\n"));
    FaultySink faulty(fault);
    MemoryTrace memory;
    request.sinks = {&faulty, &memory};
    test::FakeMachine machine;
    const auto result = run(&machine);
    ASSERT_TRUE(result) << to_string(result.error());
    ASSERT_TRUE(result->failure);
    EXPECT_THAT(result->failure->message, HasSubstr("the sink is full"));
    EXPECT_EQ(faulty.abandoned, 1);
    EXPECT_FALSE(has("trace.csv"));
    EXPECT_FALSE(memory.is_complete());
    EXPECT_GT(memory.size(), 0U);
    EXPECT_EQ(lines_of(folder / "out/trace.partial.csv"), memory.size());
    const auto n = machine.references.size();
    EXPECT_LT((machine.references[n - 1] - machine.references[n - 2]).norm(), 1e-3);
    EXPECT_GE(machine.deactivations, 1);
  }
}

TEST_F(RunProgram, ASinkThatCannotBeginKeepsTheRunFromStarting) {
  FaultySink before(FaultySink::Fault::kNone);
  FaultySink faulty(FaultySink::Fault::kBegin);
  request.sinks = {&before, &faulty};
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "the sink is full");
  EXPECT_EQ(before.abandoned, 1);
  EXPECT_EQ(faulty.abandoned, 0);
  EXPECT_TRUE(machine.references.empty());
}

TEST_F(RunProgram, ASinkThatCannotCommitLeavesThePartialTrace) {
  FaultySink faulty(FaultySink::Fault::kCommit);
  request.sinks = {&faulty};
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_TRUE(result);
  ASSERT_TRUE(result->failure);
  EXPECT_TRUE(has("trace.partial.csv"));
  EXPECT_FALSE(has("trace.csv"));
}

}  // namespace trace_sinks_test
}  // namespace twin::runtime
