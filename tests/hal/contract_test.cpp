#include <gtest/gtest.h>
#include "hal/mujoco/mujoco_machine.hpp"
TEST(X, Y) {
  twin::hal::TableParams p;
  p.model = TWIN_SOURCE_DIR "/mjcf/xy_table.xml";
  twin::hal::MujocoMachine m(p);
  auto r = m.configure(1e-3);
  ASSERT_TRUE(r) << to_string(r.error());
}
