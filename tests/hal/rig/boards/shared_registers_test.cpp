#include "hal/rig/boards/shared_registers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hal/rig/boards/emulated_pci1716.hpp"

namespace twin::hal::rig::boards {
namespace shared_registers_test {

using ::testing::HasSubstr;

class Shared : public ::testing::Test {
 protected:
  ~Shared() override { ::shm_unlink(name.c_str()); }

  /// Runs something in a child process that ends without any destructor.
  template <class F>
  static int in_child(F&& f) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::_exit(f());
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  static Expected<std::unique_ptr<SharedRegisters>> create_published(const std::string& name) {
    auto shared = SharedRegisters::create(name);
    if (shared) {
      (*shared)->publish();
    }
    return shared;
  }

  const std::string name =
      fmt::format("/twin-test-{}-{}", ::getpid(),
                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Shared, BothSidesSeeTheSameRegisters) {
  const auto emulator = create_published(name);
  ASSERT_TRUE(emulator) << to_string(emulator.error());
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_TRUE(controller) << to_string(controller.error());
  EmulatedPci1716((*controller)->boards().pci1716).write16(0x0A, 0x9000);
  EXPECT_EQ((*emulator)->boards().pci1716.dac[0].load(), 0x9000);
  EXPECT_EQ((*emulator)->block().controller.load(), ::getpid());
}

TEST_F(Shared, OnlyTheUserMayOpenIt) {
  const auto emulator = create_published(name);
  ASSERT_TRUE(emulator);
  struct stat status {};
  ASSERT_EQ(::stat(("/dev/shm" + name).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
}

TEST_F(Shared, ThereIsOneEmulatorOfAName) {
  const auto emulator = create_published(name);
  ASSERT_TRUE(emulator);
  const auto other = create_published(name);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr(fmt::format("process {}", ::getpid())));
}

TEST_F(Shared, WithoutAnEmulatorTheMessageSaysHowToStartOne) {
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_FALSE(controller);
  EXPECT_THAT(controller.error().message, HasSubstr("no emulator is running"));
  EXPECT_THAT(controller.error().message, HasSubstr("twin rig emulate"));
  EXPECT_EQ(exit_status(controller.error()), 1);
}

TEST_F(Shared, WhatADeadEmulatorLeftIsRefusedAndTakenOverByTheNextOne) {
  ASSERT_EQ(in_child([this] { return create_published(name).value().release() ? 0 : 1; }), 0);
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_FALSE(controller);
  EXPECT_THAT(controller.error().message, HasSubstr("is dead"));
  const auto emulator = create_published(name);
  ASSERT_TRUE(emulator) << to_string(emulator.error());
  EXPECT_EQ((*emulator)->block().emulator.load(), ::getpid());
}

TEST_F(Shared, NobodyAttachesBeforeTheCardsAreOn) {
  const auto emulator = SharedRegisters::create(name);
  ASSERT_TRUE(emulator);
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_FALSE(controller);
  EXPECT_THAT(controller.error().message, HasSubstr("is still starting"));
}

TEST_F(Shared, AnotherVersionIsRefused) {
  const auto emulator = create_published(name);
  ASSERT_TRUE(emulator);
  (*emulator)->block().version.store(kSharedVersion + 1);
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_FALSE(controller);
  EXPECT_THAT(controller.error().message, HasSubstr(fmt::format("version {}", kSharedVersion + 1)));
}

TEST_F(Shared, AnotherSizeIsRefused) {
  const int file = ::shm_open(name.c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(file, 0);
  ASSERT_EQ(::ftruncate(file, 100), 0);
  ::close(file);
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_FALSE(controller);
  EXPECT_THAT(controller.error().message, HasSubstr("not that of this version"));
}

TEST_F(Shared, TheEndOfTheEmulatorTakesTheCardsAndTheMemoryAway) {
  auto emulator = create_published(name);
  ASSERT_TRUE(emulator);
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_TRUE(controller);
  emulator->reset();
  EXPECT_TRUE((*controller)->block().has_ended.load());
  EXPECT_EQ(EmulatedPci1716((*controller)->boards().pci1716).read16(0x10), 0xFFFF);
  EXPECT_FALSE(SharedRegisters::attach(name, SharedRole::kController));
}

TEST_F(Shared, AKilledEmulatorLeavesItsRegistersAsTheyWere) {
  ASSERT_EQ(::mkfifo(("/tmp" + name).c_str(), 0600), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    auto emulator = create_published(name);
    (*emulator)->boards().pci1716.digital_in.store(0x1234);
    ::close(::open(("/tmp" + name).c_str(), O_WRONLY));
    ::pause();
    ::_exit(0);
  }
  ::close(::open(("/tmp" + name).c_str(), O_RDONLY));
  ::unlink(("/tmp" + name).c_str());
  const auto controller = SharedRegisters::attach(name, SharedRole::kController);
  EXPECT_TRUE(is_running(child));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ASSERT_TRUE(controller) << to_string(controller.error());
  EXPECT_FALSE(is_running(child));
  EXPECT_EQ(EmulatedPci1716((*controller)->boards().pci1716).read16(0x10), 0x1234);
}

TEST_F(Shared, ThereIsOneControllerAtATimeAndADeadOneGivesWay) {
  const auto emulator = create_published(name);
  ASSERT_TRUE(emulator);
  ASSERT_EQ(in_child([this] {
              return SharedRegisters::attach(name, SharedRole::kController).value().release() ? 0
                                                                                              : 1;
            }),
            0);
  auto controller = SharedRegisters::attach(name, SharedRole::kController);
  ASSERT_TRUE(controller) << "its predecessor is dead";
  EXPECT_EQ(in_child([this] {
              return SharedRegisters::attach(name, SharedRole::kController).has_value() ? 1 : 0;
            }),
            0);
  EXPECT_TRUE(SharedRegisters::attach(name, SharedRole::kObserver));
  controller->reset();
  EXPECT_EQ((*emulator)->block().controller.load(), 0);
}

}  // namespace shared_registers_test
}  // namespace twin::hal::rig::boards
