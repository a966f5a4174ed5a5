#include "hal/rig/guard/guard_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <functional>
#include <thread>

#include "tests/support/guard_view.hpp"
#include "tests/support/temp_folder.hpp"

// The guard as the program it is. Its card is an ordinary file in place of a sysfs resource.
namespace twin::hal::rig::guard {
namespace guard_process_test {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr std::size_t kDac0 = 0x0A;
constexpr std::size_t kDac1 = 0x0C;
constexpr std::size_t kRange = 0x0E;
constexpr std::size_t kDigital = 0x10;

bool becomes(const std::function<bool()>& is_so) {
  for (int i = 0; i < 5000; ++i) {
    if (is_so()) {
      return true;
    }
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

class GuardProcessTest : public ::testing::Test {
 protected:
  GuardProcessTest() {
    card = folder.put("resource2", std::string(32, '\x11'));
    target.program = TWIN_GUARD;
    target.outputs = "sysfs:" + card.string();
    target.safe_digital = 0x00A0;
    target.timeout = 1h;
  }

  unsigned word(std::size_t offset) const {
    std::ifstream file(card, std::ios::binary);
    std::array<unsigned char, 2> bytes{};
    file.seekg(static_cast<std::streamoff>(offset));
    file.read(reinterpret_cast<char*>(bytes.data()), 2);
    return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
  }
  bool is_safe() const {
    return word(kDac0) == 0x8000 && word(kDac1) == 0x8000 && word(kRange) == 0x0101 &&
           word(kDigital) == 0x00A0;
  }
  bool is_untouched() const { return word(kDac0) == 0x1111 && word(kDigital) == 0x1111; }

  test::TempFolder folder;
  std::filesystem::path card;
  GuardTarget target;
};

TEST_F(GuardProcessTest, LeavesTheCardAloneWhileAllIsWell) {
  {
    GuardProcess guard;
    ASSERT_TRUE(guard.start(target));
    guard.arm();
    const test::GuardView view(guard.pid());
    ASSERT_TRUE(view.is_there());
    const std::uint64_t before = view.turns();
    EXPECT_TRUE(becomes([&] {
      guard.beat();
      return view.turns() >= before + 20;
    }));
    EXPECT_FALSE(guard.has_acted());
    EXPECT_TRUE(guard.is_alive());
  }
  EXPECT_TRUE(is_untouched());
}

TEST_F(GuardProcessTest, SilenceMakesTheCardSafe) {
  target.timeout = 20ms;
  GuardProcess guard;
  ASSERT_TRUE(guard.start(target));
  guard.arm();
  EXPECT_TRUE(becomes([&] { return guard.has_acted(); }));
  EXPECT_TRUE(becomes([&] { return is_safe(); }));
}

TEST_F(GuardProcessTest, ControllerKilledWhileArmedMakesTheCardSafe) {
  const pid_t controller = fork();
  if (controller == 0) {
    GuardProcess guard;
    if (!guard.start(target)) {
      _exit(1);
    }
    guard.arm();
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(controller, &status, 0), controller);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(becomes([&] { return is_safe(); }));
}

TEST_F(GuardProcessTest, SignalsOfATerminalDoNotEndIt) {
  target.timeout = 100ms;
  GuardProcess guard;
  ASSERT_TRUE(guard.start(target));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) {
    kill(guard.pid(), signal);
  }
  EXPECT_NE(getsid(guard.pid()), getsid(0));
  guard.arm();
  EXPECT_TRUE(becomes([&] { return guard.has_acted() && is_safe(); }));
}

TEST_F(GuardProcessTest, ItsOwnDeathIsNoticed) {
  GuardProcess guard;
  ASSERT_TRUE(guard.start(target));
  EXPECT_TRUE(guard.is_alive());
  kill(guard.pid(), SIGKILL);
  EXPECT_TRUE(becomes([&] { return !guard.is_alive(); }));
}

TEST_F(GuardProcessTest, CardThatCannotBeOpenedIsSaid) {
  target.outputs = "sysfs:" + (folder / "nothing").string();
  GuardProcess guard;
  const auto started = guard.start(target);
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message, HasSubstr("the guard process failed: "));
  EXPECT_THAT(started.error().message, HasSubstr("nothing"));
}

TEST_F(GuardProcessTest, ProgramThatIsMissingIsSaid) {
  target.program = folder / "no-guard";
  GuardProcess guard;
  const auto started = guard.start(target);
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message, HasSubstr("no-guard"));
}

}  // namespace guard_process_test
}  // namespace twin::hal::rig::guard
