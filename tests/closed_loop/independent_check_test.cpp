#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/units.hpp"
#include "tests/closed_loop/every_program.hpp"
#include "tests/support/files.hpp"
#include "tests/support/loop_fixture.hpp"
#include "tests/support/nc_file.hpp"

// Traces of every program with both planners, judged by programs that share no line of code with
// this project: their own reader of G-code, their own geometry. They lie beside the project's
// folder, in shared/check, where somebody has put them.
namespace twin::test {
namespace independent_check_test {

const std::filesystem::path kChecks =
    std::filesystem::path(TWIN_SOURCE_DIR).parent_path() / "shared/check";
constexpr const char* kPython = "/usr/bin/python3";

class IndependentCheck : public LoopTest, public ::testing::WithParamInterface<ProgramCase> {
 protected:
  void SetUp() override {
    for (const char* const check : {"limit_audit.py", "contour_error.py"}) {
      if (!std::filesystem::exists(kChecks / check)) {
        GTEST_SKIP() << "there is no " << (kChecks / check).string();
      }
    }
    if (access(kPython, X_OK) != 0) {
      GTEST_SKIP() << "there is no " << kPython;
    }
    file_ = machine();
    file_.path.planner = GetParam().planner;
    execute(nc(), file_, nullptr, std::nullopt);
  }

  std::filesystem::path nc() const { return program(GetParam().program); }
  std::filesystem::path trace() const { return folder / "out/trace.csv"; }

  /// Runs a check. @returns its exit status; what it says goes to a file
  int check(const std::string& arguments) const {
    const int status = std::system(
        fmt::format("{} '{}'/{} > '{}' 2>&1", kPython, kChecks.string(), arguments, said_.string())
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string said() const { return content(said_); }

  config::MachineFile file_;

 private:
  std::filesystem::path said_ = folder / "said.txt";
};

/// Largest feedrate that a program asks for [mm/s].
double fastest(const std::string& program, const Limits& limits) {
  double feedrate = 0.0;
  for (const std::string& line : code_lines(program)) {
    feedrate = std::max(feedrate, units::mm_per_s_from_mm_per_min(word(line, 'F', 0.0)));
    if (line.find("G00") != std::string::npos) {
      feedrate = std::max(feedrate, limits.rapid_feedrate);
    }
  }
  return std::min(feedrate, limits.feedrate);
}

TEST_P(IndependentCheck, FindsTheLimitsKept) {
  const Limits& limits = file_.limits;
  EXPECT_EQ(
      check(fmt::format("limit_audit.py '{}' --feed {} --a {} --j {}", trace().string(),
                        fastest(GetParam().program, limits), limits.acceleration, limits.jerk)),
      0)
      << said();
}

TEST_P(IndependentCheck, FindsThePathWithinItsTolerance) {
  EXPECT_EQ(check(fmt::format("contour_error.py '{}' '{}' --tolerance-um {}", nc().string(),
                              trace().string(), units::um_from_mm(file_.path.chord_error))),
            0)
      << said();
}

INSTANTIATE_TEST_SUITE_P(Programs, IndependentCheck, ::testing::ValuesIn(every_program()),
                         [](const auto& tested) { return tested.param.name(); });

}  // namespace independent_check_test
}  // namespace twin::test
