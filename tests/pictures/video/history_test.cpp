#include "pictures/video/history.hpp"

#include <gtest/gtest.h>

namespace twin::pictures::video {
namespace history_test {

TEST(History, HasTheLargestOfEachStepInBoundedMemory) {
  History history;
  constexpr int rows = 100000;
  for (int k = 0; k < rows; ++k) {
    TraceRow row;
    row.t = 1e-3 * k;
    row.feedrate = k == 40000 ? 80.0 : 50.0;
    row.error_um = k == 70001 || k == 20000 ? 9.0 : 1.0;
    history.add(row, k != 20000);
  }
  const auto& steps = history.steps();
  ASSERT_LE(steps.size(), 2048U);
  const auto at = [&](int k) {
    return steps[static_cast<std::size_t>(1e-3 * k / history.step_length())];
  };
  EXPECT_GE(static_cast<double>(steps.size()) * history.step_length(), 99.9);
  EXPECT_EQ(at(40000).feedrate, 80.0);
  EXPECT_EQ(at(70001).error_um, 9.0);
  EXPECT_EQ(at(20000).error_um, 1.0);  // the pen was up
  EXPECT_EQ(at(90000).feedrate, 50.0);
}

}  // namespace history_test
}  // namespace twin::pictures::video
