#include "hal/mujoco/mujoco_library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace twin::hal::mujoco {
namespace mujoco_library_test {

using ::testing::HasSubstr;

TEST(MujocoLibrary, IsLoadedOnce) {
  const auto first = MujocoLibrary::load();
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(*MujocoLibrary::load(), *first);
  EXPECT_EQ(&MujocoLibrary::loaded(), *first);
}

TEST(MujocoLibrary, IsTheOneThatThisTestLinks) {
  const auto library = MujocoLibrary::load();
  ASSERT_TRUE(library) << library.error().message;
  EXPECT_EQ((*library)->step, &::mj_step);
}

TEST(MujocoLibrary, AMissingLibraryIsAModelError) {
  const auto library = MujocoLibrary::open("libno_such_mujoco.so");
  ASSERT_FALSE(library);
  EXPECT_EQ(library.error().code, ErrorCode::kModel);
  EXPECT_THAT(library.error().message, HasSubstr("MuJoCo cannot be loaded: libno_such_mujoco.so"));
}

TEST(MujocoLibrary, ALibraryWithoutItsFunctionsIsAModelError) {
  const auto library = MujocoLibrary::open("libm.so.6");
  ASSERT_FALSE(library);
  EXPECT_EQ(library.error().code, ErrorCode::kModel);
  EXPECT_EQ(library.error().message, "MuJoCo cannot be loaded: libm.so.6 has no mj_version");
}

}  // namespace mujoco_library_test
}  // namespace twin::hal::mujoco
