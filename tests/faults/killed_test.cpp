#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/faults/whole_files.hpp"
#include "tests/support/cli_fixture.hpp"

// kill -9 at random instants: what has its final name is whole, children die, a next run works.
namespace twin::faults {
namespace killed_test {

using Clock = std::chrono::steady_clock;
using ::testing::IsEmpty;

/// How often each command is killed. TWIN_KILLS=50 tests/run KilledAtAnyInstant
int kills(int otherwise) {
  const char* const wanted = std::getenv("TWIN_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : otherwise;
}

struct Row {
  const char* name;
  std::vector<std::string> command;
  int kills;  ///< by default
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class KilledAtAnyInstant : public test::CliTest, public ::testing::WithParamInterface<Row> {
 protected:
  /// Runs the command to its end. @returns how long it took [s]
  double time_of_one() const {
    const auto begin = Clock::now();
    const auto first = twin(GetParam().command);
    EXPECT_EQ(first.status, 0) << first.err;
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }
  bool no_process_is_left() const {
    for (int i = 0; i < 400; ++i) {
      if (test::processes_in(folder.path()).empty()) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
};

TEST_P(KilledAtAnyInstant, LeavesNoFileThatPosesAsWholeAndNoChildAndTheNextRunWorks) {
  folder.put("short.nc", "G01 X1 F1200\nX0 Y1\nM30\n");
  folder.put(
      "sweep.toml",
      "program = \"short.nc\"\ntrace = \"hdf5\"\n[grid]\n\"servo.x.kp_per_s\" = [100, 150]\n");
  ASSERT_EQ(twin({"run", "short.nc", "--out", "earlier", "--no-plots", "--quiet"}).status, 0);
  const bool is_short = GetParam().name == std::string("reproduce") && kills(0) == 0;
  const double whole = is_short ? 3.0 : time_of_one();
  std::mt19937 random(1);
  for (int i = 0; i < kills(GetParam().kills); ++i) {
    test::Child child(GetParam().command, {folder.path(), {}});
    std::this_thread::sleep_for(std::chrono::duration<double>(
        whole * std::uniform_real_distribution<double>(0.02, 0.98)(random)));
    child.signal(SIGKILL);
    child.wait();
    EXPECT_TRUE(no_process_is_left());
    EXPECT_THAT(test::broken_files(folder.path()), IsEmpty());
  }
  if (is_short) {
    return;
  }
  const auto next = twin(GetParam().command);
  EXPECT_EQ(next.status, 0) << next.err;
  EXPECT_THAT(test::broken_files(folder.path()), IsEmpty());
  EXPECT_THAT(test::unfinished_files(folder.path()), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Commands, KilledAtAnyInstant,
    ::testing::Values(
        Row{"run", {"run", "ok.nc", "--out", "out", "--quiet"}, 1},
        Row{"plan", {"plan", "ok.nc", "--out", "out", "--bound", "--quiet"}, 1},
        Row{"render", {"render", "earlier", "--video", "--quiet"}, 1},
        Row{"compare",
            {"compare", "ok.nc", "--out", "out", "--hal", "ideal", "--no-plots", "--quiet"},
            1},
        Row{"reproduce",
            {"reproduce", "--repeats", "0", "--no-plots", "--out", "out", "--quiet"},
            1},
        Row{"run_with_hdf5",
            {"run", "ok.nc", "--out", "out", "--trace", "both", "--no-plots", "--quiet"},
            1},
        Row{"sweep", {"sweep", "sweep.toml", "--out", "out", "--quiet"}, 1},
        Row{"compensate", {"compensate", "short.nc", "--out", "c.csv", "--quiet"}, 1},
        Row{"report", {"report", "earlier", "--quiet"}, 1}),
    [](const auto& test) { return test.param.name; });

}  // namespace killed_test
}  // namespace twin::faults
