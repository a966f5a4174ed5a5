#include "hal/rig/emulator/serve.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <mutex>
#include <thread>

#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/emulator/shared_bench.hpp"
#include "tests/support/table_files.hpp"

namespace twin::hal::rig::emulator {
namespace serve_test {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Waits for something, a minute at most.
template <class F>
bool wait_for(F&& is_so) {
  for (int i = 0; i < 60'000; ++i) {
    if (is_so()) {
      return true;
    }
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

std::shared_ptr<boards::SharedRegisters> attach(const std::string& name) {
  std::shared_ptr<boards::SharedRegisters> shared;
  wait_for([&] {
    auto attached = boards::SharedRegisters::attach(name, boards::SharedRole::kController);
    shared = attached ? std::move(*attached) : nullptr;
    return shared != nullptr;
  });
  return shared;
}

/// Servo on, and a voltage to X.
void drive_x(boards::SharedRegisters& shared, std::uint16_t code) {
  boards::EmulatedPci1716 port(shared.boards().pci1716);
  port.write16(0x0A, 0x8000);
  port.write16(0x0C, 0x8000);
  port.write16(0x0E, 0x0101);
  port.write16(0x10, 0x0005);
  port.write16(0x0A, code);
}

/// The emulator in a thread of its own.
class Serve : public ::testing::Test {
 protected:
  ~Serve() override { end(); }

  void start(ServeSettings settings = {}) {
    settings.name = name;
    thread_ = std::thread([this, settings] {
      result = serve(test::default_table(), RigSettings{}, settings, stop_,
                     [this](std::string_view line) {
                       const std::lock_guard lock(mutex_);
                       lines_.emplace_back(line);
                     });
    });
  }

  void end() {
    stop_.store(true);
    join();
  }

  void join() {
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

  bool is_told(const std::string& part) {
    return wait_for([&] {
      for (const std::string& line : lines()) {
        if (line.find(part) != std::string::npos) {
          return true;
        }
      }
      return false;
    });
  }

  const std::string name =
      fmt::format("/twin-test-{}-{}", ::getpid(),
                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
  Expected<ServeResult> result;

 private:
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::vector<std::string> lines_;
  std::thread thread_;
};

TEST_F(Serve, TheTableMovesByItselfAsTheRegistersSay) {
  start();
  const auto shared = attach(name);
  ASSERT_NE(shared, nullptr);
  SharedBench bench(shared);
  boards::EmulatedPci1784 counters(shared->boards().pci1784);
  counters.write32(0x00, 0x193);
  drive_x(*shared, 0x9000);  // 1.25 V
  EXPECT_TRUE(wait_for([&] {
    counters.write32(0x28, 0x1);
    return static_cast<std::int32_t>(counters.read32(0x00)) > 500;
  }));
  EXPECT_GT(bench.truth().table_position[kX], 4.9);
  EXPECT_TRUE(is_told("servo x ready"));
  EXPECT_TRUE(is_told("DAC 0 leaves 0x8000 for 0x9000"));
  EXPECT_TRUE(is_told("digital outputs 0x0005"));
  EXPECT_TRUE(is_told(fmt::format("controller {} joined", ::getpid())));
}

TEST_F(Serve, TheEndTakesTheCardsAwayAndTheMemoryWithThem) {
  start();
  const auto shared = attach(name);
  ASSERT_NE(shared, nullptr);
  end();
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(boards::EmulatedPci1716(shared->boards().pci1716).read16(0x06), 0xFFFF);
  EXPECT_FALSE(SharedBench(shared).power_on(1e-3));
  EXPECT_FALSE(boards::SharedRegisters::attach(name, boards::SharedRole::kObserver));
}

TEST_F(Serve, EndsAfterItsDurationOfTheWallClock) {
  start({.duration = 0.05});
  join();
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_NEAR(result->plant_time + result->left_out, 0.05, 1e-3);
}

TEST_F(Serve, AControllerThatIsKilledIsTold) {
  const pid_t child = ::fork();  // before there are threads
  if (child == 0) {
    if (const auto shared = attach(name)) {
      drive_x(*shared, 0x8800);
      ::pause();
    }
    ::_exit(1);
  }
  start();
  EXPECT_TRUE(is_told(fmt::format("controller {} joined", child)));
  EXPECT_TRUE(is_told("DAC 0 leaves 0x8000 for 0x8800"));
  ::kill(child, SIGKILL);
  EXPECT_TRUE(is_told(fmt::format("controller {} died", child)));
  ::waitpid(child, nullptr, 0);
  const auto guard = attach(name);
  ASSERT_NE(guard, nullptr) << "a dead controller gives way";
  drive_x(*guard, 0x8000);
  EXPECT_TRUE(is_told("DAC 0 at 0x8000"));
}

TEST_F(Serve, AControllerThatLeavesIsTold) {
  start();
  attach(name).reset();
  // It may have come and gone between two looks.
  auto shared = attach(name);
  EXPECT_TRUE(is_told("joined"));
  shared.reset();
  EXPECT_TRUE(is_told("left"));
}

TEST_F(Serve, FaultsStrike) {
  start({.faults = {{FaultKind::kAlarm, kX, 0.02}}});
  const auto shared = attach(name);
  ASSERT_NE(shared, nullptr);
  drive_x(*shared, 0x8000);
  EXPECT_TRUE(is_told("fault alarm of x"));
  EXPECT_TRUE(is_told("alarm of drive x"));
  EXPECT_TRUE(is_told("servo x off"));
}

TEST_F(Serve, ASecondEmulatorIsRefused) {
  start();
  ASSERT_NE(attach(name), nullptr);
  const std::atomic<bool> stop{false};
  const auto second =
      serve(test::default_table(), RigSettings{}, {.name = name}, stop, [](std::string_view) {});
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("an emulator is running already"));
}

}  // namespace serve_test
}  // namespace twin::hal::rig::emulator
