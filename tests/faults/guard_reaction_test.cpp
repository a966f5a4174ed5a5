#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "hal/rig/guard/guard_process.hpp"
#include "tests/faults/guard_witness.hpp"
#include "tests/support/files.hpp"
#include "tests/support/guard_view.hpp"
#include "tests/support/temp_folder.hpp"

// How long the guard takes to make the outputs safe, as a distribution: the program twin-guard, its
// card an ordinary file, and a controller that beats once a millisecond until it dies or hangs.
namespace twin::test {
namespace guard_reaction_test {

using hal::rig::guard::GuardProcess;
using hal::rig::guard::GuardTarget;

constexpr int kReactions = 24;
constexpr double kShare = 0.9;     // of the reactions, which must be in time
constexpr double kInTime = 0.025;  // [s]

/// The card of the outputs: 32 registers in a file, seen as the card would see them.
class Card {
 public:
  Card() : file_(folder_.put("resource2", std::string(kSize, '\x11'))) {
    const int descriptor = open(file_.c_str(), O_RDONLY | O_CLOEXEC);
    void* const mapped = mmap(nullptr, kSize, PROT_READ, MAP_SHARED, descriptor, 0);
    close(descriptor);
    bytes_ = mapped == MAP_FAILED ? nullptr : static_cast<const volatile unsigned char*>(mapped);
    EXPECT_NE(bytes_, nullptr);
  }
  Card(const Card&) = delete;
  Card& operator=(const Card&) = delete;
  ~Card() { munmap(const_cast<unsigned char*>(bytes_), kSize); }

  std::string port() const { return "sysfs:" + file_.string(); }
  /// 0 V on both converters, and the servos off.
  bool is_safe() const { return word(0x0A) == 0x8000 && word(0x0C) == 0x8000 && word(0x10) == 0; }

 private:
  static constexpr std::size_t kSize = 32;

  unsigned word(std::size_t at) const {
    return static_cast<unsigned>(bytes_[at]) | static_cast<unsigned>(bytes_[at + 1]) << 8;
  }

  TempFolder folder_;
  std::filesystem::path file_;
  const volatile unsigned char* bytes_ = nullptr;
};

/// A process that has a guard, arms it and beats once a millisecond.
class BeatingController {
 public:
  explicit BeatingController(const Card& card) {
    GuardTarget target;
    target.program = TWIN_GUARD;
    target.outputs = card.port();
    pid_ = fork();
    if (pid_ == 0) {
      beat(target);
    }
  }
  BeatingController(const BeatingController&) = delete;
  BeatingController& operator=(const BeatingController&) = delete;
  ~BeatingController() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  void signal(int number) const { kill(pid_, number); }
  pid_t pid() const { return pid_; }

 private:
  [[noreturn]] static void beat(const GuardTarget& target) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive the test
    GuardProcess guard;
    if (!guard.start(target)) {
      _exit(1);
    }
    guard.arm();
    for (;;) {
      guard.beat();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  pid_t pid_ = -1;
};

/// What a fault did.
struct Reaction {
  double time = 0.0;        ///< from the fault to safe outputs, without standstills [s]
  double standstill = 0.0;  ///< of the machine, in that time [s]
};

/// One fault, from a controller that is well to outputs that are safe.
std::optional<Reaction> reaction_to(int signal, std::mt19937& random) {
  const Card card;
  const BeatingController controller(card);
  std::optional<pid_t> guard;
  for (int i = 0; i < 10000 && !guard; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    guard = child_of(controller.pid());
  }
  // Its arguments are there once it is a program of its own.
  for (int i = 0; guard && i < 10000; ++i) {
    if (content("/proc/" + std::to_string(*guard) + "/cmdline").starts_with(TWIN_GUARD)) {
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!guard) {
    return std::nullopt;
  }
  const GuardView view(*guard);
  if (!view.is_there()) {
    return std::nullopt;
  }
  GuardWitness witness(view);
  if (!witness.sees_heartbeats(5 + random() % 10)) {
    return std::nullopt;
  }
  const double fault = monotonic();
  controller.signal(signal);
  const auto standstill =
      witness.standstill_until(fault, [&] { return view.has_acted() && card.is_safe(); });
  if (!standstill) {
    return std::nullopt;
  }
  return Reaction{monotonic() - fault - *standstill, *standstill};
}

class GuardReaction : public ::testing::TestWithParam<int> {};

TEST_P(GuardReaction, NineOfTenAreWithinTwentyFiveMilliseconds) {
  std::mt19937 random(1);
  std::vector<double> times;
  double standstill = 0.0;
  for (int i = 0; i < kReactions; ++i) {
    const auto reaction = reaction_to(GetParam(), random);
    ASSERT_TRUE(reaction) << "the outputs were not made safe";
    times.push_back(reaction->time);
    standstill += reaction->standstill;
  }
  std::sort(times.begin(), times.end());
  const auto quantile = [&](double share) {
    return times[static_cast<std::size_t>(std::ceil(share * kReactions)) - 1];
  };
  const std::string distribution = fmt::format(
      "{} reactions to SIG{}, ms: least {:.2f}, median {:.2f}, 90 % {:.2f}, most {:.2f}; the "
      "machine stood still for {:.1f} ms",
      kReactions, sigabbrev_np(GetParam()), 1e3 * times.front(), 1e3 * quantile(0.5),
      1e3 * quantile(kShare), 1e3 * times.back(), 1e3 * standstill);
  fmt::print("{}\n", distribution);
  RecordProperty("reactions", distribution);
  EXPECT_LE(quantile(kShare), kInTime) << distribution;
}

// SIGSTOP is a controller that hangs: it is alive, and silent.
INSTANTIATE_TEST_SUITE_P(Signals, GuardReaction,
                         ::testing::Values(SIGKILL, SIGSEGV, SIGABRT, SIGFPE, SIGQUIT, SIGSTOP),
                         [](const auto& test) { return std::string(sigabbrev_np(test.param)); });

}  // namespace guard_reaction_test
}  // namespace twin::test
