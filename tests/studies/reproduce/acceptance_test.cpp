#include <gtest/gtest.h>

#include <cmath>

#include "config/find_file.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "studies/reproduce/counts.hpp"
#include "tests/support/temp_folder.hpp"

// The default machine file against the paper's tables, all rows.
namespace twin::studies::reproduce {
namespace acceptance_test {

TEST(PublishedTables, AreReproducedByOneSetOfParameters) {
  const test::TempFolder folder;
  Request request;
  request.published = *published();
  request.machine_file = *config::find_machine(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
  request.repeats = 4;
  request.folder = folder.path();
  request.running.make_machine = [](const config::MachineFile& machine) {
    return std::make_unique<hal::mujoco::MujocoMachine>(machine.table);
  };
  const auto result = reproduce(request);
  ASSERT_TRUE(result) << to_string(result.error());
  const Counts counts = count(result->as_published(), Of::kMean);
  EXPECT_EQ(counts.total, 56);
  EXPECT_GE(counts.within[1], 48);
  EXPECT_GE(counts.within[2], 52);
  EXPECT_LT(std::abs(counts.worst_time), 0.02);

  // With the remainder carried over the tracking maxima of the NURBS rows are lower.
  for (std::size_t i = 0; i < result->as_published().answers.size(); ++i) {
    const Answer& landed = result->as_published().answers[i];
    const Answer& carried = result->defaults().answers[i];
    if (landed.published.table < 4 || landed.published.interpolator != "nurbs") {
      continue;
    }
    for (const std::size_t x_or_y_max : {2U, 4U}) {
      EXPECT_LT(carried.repeats[x_or_y_max].mean, landed.repeats[x_or_y_max].mean)
          << landed.published.name();
    }
  }
}

}  // namespace acceptance_test
}  // namespace twin::studies::reproduce
