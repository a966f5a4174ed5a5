#include "hal/linuxcnc/shared_segment.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/hal/linuxcnc/fake_shim.hpp"

namespace twin::hal::linuxcnc {
namespace shared_segment_test {

using ::testing::HasSubstr;

mode_t mode_of(const std::string& name) {
  struct stat status {};
  EXPECT_EQ(::stat(("/dev/shm" + name).c_str(), &status), 0);
  return status.st_mode & 0777U;
}

bool exists(const std::string& name) { return ::access(("/dev/shm" + name).c_str(), F_OK) == 0; }

class SegmentTest : public ::testing::Test {
 protected:
  ~SegmentTest() override { ::shm_unlink(name.c_str()); }
  std::string refusal_to_plant() const {
    const auto made = SharedSegment::make_plant(name);
    return made ? std::string("none") : made.error().message;
  }
  std::string refusal_to_control() const {
    const auto attached = SharedSegment::attach_controller(name);
    return attached ? std::string("none") : attached.error().message;
  }
  const std::string name = test::unused_segment_name();
  test::FakeShim shim;
};

TEST_F(SegmentTest, IsItsOwnersAloneAndGoneWithIt) {
  {
    const auto made = SharedSegment::make_plant(name);
    ASSERT_TRUE(made);
    EXPECT_EQ(mode_of(name), 0600U);
  }
  EXPECT_FALSE(exists(name));
}

TEST_F(SegmentTest, OneThatOthersCanUseIsRefused) {
  const auto made = SharedSegment::make_plant(name);
  ASSERT_TRUE(made);
  ASSERT_EQ(::chmod(("/dev/shm" + name).c_str(), 0644), 0);
  EXPECT_THAT(refusal_to_plant(), HasSubstr("has mode 644: others than its owner can use it"));
}

TEST_F(SegmentTest, OneOfAnotherUserIsRefused) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "only root can make a file of another user";
  }
  const auto made = SharedSegment::make_plant(name);
  ASSERT_TRUE(made);
  ASSERT_EQ(::chown(("/dev/shm" + name).c_str(), 4321, 4321), 0);
  EXPECT_THAT(refusal_to_plant(), HasSubstr("belongs to user 4321"));
}

TEST_F(SegmentTest, RootGivesItToTheUserOfLinuxCnc) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "only root has to";
  }
  ::setenv("RTAPI_UID", "4321", 1);
  {
    const auto made = SharedSegment::make_plant(name);
    ASSERT_TRUE(made);
    struct stat status {};
    ASSERT_EQ(::stat(("/dev/shm" + name).c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, 4321U);
    EXPECT_EQ(default_segment_name(Role::kPlant), "/twin-plant-4321");
  }
  ::unsetenv("RTAPI_UID");
}

TEST_F(SegmentTest, OneOfAnotherVersionIsReplacedUnlessItIsInUse) {
  {
    test::FakeShim old;
    old.make(name);
    old.memory->use = TWIN_USE_PLANT;
    old.memory->version = TWIN_SEGMENT_VERSION + 1;
    EXPECT_THAT(refusal_to_plant(), HasSubstr("is of another version of twin: version 2"));
  }
  shim.make(name);
  shim.memory->use = TWIN_USE_PLANT;
  shim.memory->version = TWIN_SEGMENT_VERSION + 1;
  ASSERT_EQ(::rename(("/dev/shm" + name).c_str(), ("/dev/shm" + name + "-kept").c_str()), 0);
  shim.leave();
  ASSERT_EQ(::rename(("/dev/shm" + name + "-kept").c_str(), ("/dev/shm" + name).c_str()), 0);
  EXPECT_EQ(refusal_to_plant(), "none");
}

TEST_F(SegmentTest, AControllerNeedsAComponent) {
  EXPECT_THAT(refusal_to_control(), HasSubstr("loadrt twinctl"));
  shim.make(name);
  EXPECT_EQ(refusal_to_control(), "none");
  const auto first = SharedSegment::attach_controller(name);
  ASSERT_TRUE(first);
  EXPECT_THAT(refusal_to_control(), HasSubstr("another controller drives"));
}

TEST_F(SegmentTest, AComponentOfAnotherVersionIsRefused) {
  shim.make(name);
  shim.memory->version = 7;
  EXPECT_THAT(refusal_to_control(), HasSubstr("another version of twin: version 7"));
}

}  // namespace shared_segment_test
}  // namespace twin::hal::linuxcnc
