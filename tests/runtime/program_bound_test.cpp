#include "runtime/program_bound.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"
#include "tests/support/program_text.hpp"

namespace twin::runtime {
namespace program_bound_test {

/// Every program of the project, with a planner and a curve kind.
class ProgramBound : public testing::TestWithParam<Planner> {};

TEST_P(ProgramBound, NoPlanIsFasterThanItsBound) {
  for (const char* name : {"oxalis", "dolphin", "butterfly", "butterfly_nurbs", "square", "mixed",
                           "circle", "zigzag", "star", "gear"}) {
    const auto file = fmt::format("{}/nc_programs/{}.nc", TWIN_SOURCE_DIR, name);
    for (const double feedrate : {50.0, 200.0}) {
      config::MachineFile machine;
      machine.path.planner = GetParam();
      auto reader = gcode::Reader::open(file, {.feedrate = feedrate});
      ASSERT_TRUE(reader);
      const auto plan = plan_program(*reader, machine, [](auto&&) { return true; });
      const auto bound = time_bound(test::text_of(file), machine, feedrate);
      ASSERT_TRUE(plan && bound);
      EXPECT_LE(*bound, plan->time * (1.0 + 1e-9)) << name;
      EXPECT_GT(*bound, plan->path_length / std::max(feedrate, machine.limits.rapid_feedrate))
          << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryPlanner, ProgramBound,
                         testing::Values(Planner::kPaper, Planner::kCertified),
                         [](const auto& test) {
                           return test.param == Planner::kPaper ? "paper" : "certified";
                         });

}  // namespace program_bound_test
}  // namespace twin::runtime
