#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "hal/rig/guard/guard_protocol.hpp"
#include "tests/support/files.hpp"

namespace twin::test {

/// CLOCK_MONOTONIC [s], the clock of the emulator's log.
inline double monotonic() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The first child of a process; nothing while it has none. A controller's only child is its guard.
inline std::optional<pid_t> child_of(pid_t parent) {
  const std::string pid = std::to_string(parent);
  std::ifstream children("/proc/" + pid + "/task/" + pid + "/children");
  pid_t child = 0;
  return children >> child ? std::optional(child) : std::nullopt;
}

/// The memory that a guard shares with its controller, read by a third process.
///
/// It shows the guard's own clock: its loop takes a turn a millisecond and counts it. The mapping
/// outlives both processes.
class GuardView {
 public:
  /// @param guard  a running twin-guard, whose command line names the descriptor of the memory
  explicit GuardView(pid_t guard) {
    const std::string process = "/proc/" + std::to_string(guard);
    const std::string line = content(process + "/cmdline");
    const std::string key = std::string("--page") + '\0';
    const std::size_t at = line.find(key);
    EXPECT_NE(at, std::string::npos) << "no guard: " << line;
    if (at == std::string::npos) {
      return;
    }
    const std::string number = line.c_str() + at + key.size();
    const int file = open((process + "/fd/" + number).c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_GE(file, 0) << process << "/fd/" << number;
    void* const mapped =
        mmap(nullptr, sizeof(hal::rig::guard::GuardPage), PROT_READ, MAP_SHARED, file, 0);
    close(file);
    page_ = mapped == MAP_FAILED ? nullptr : static_cast<const hal::rig::guard::GuardPage*>(mapped);
  }
  GuardView(const GuardView&) = delete;
  GuardView& operator=(const GuardView&) = delete;
  ~GuardView() {
    if (page_ != nullptr) {
      munmap(const_cast<hal::rig::guard::GuardPage*>(page_), sizeof(hal::rig::guard::GuardPage));
    }
  }

  bool is_there() const { return page_ != nullptr; }
  std::uint64_t turns() const { return page_->turns; }
  std::uint64_t heartbeats() const { return page_->heartbeats; }
  bool has_acted() const { return page_->state == hal::rig::guard::GuardState::kActed; }

 private:
  const hal::rig::guard::GuardPage* page_ = nullptr;
};

}  // namespace twin::test
