#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <climits>
#include <string>
#include <thread>

#include "hal/linuxcnc/segment.h"

namespace twin::test {

/// Name of a shared memory that no other test uses.
inline std::string unused_segment_name() {
  static std::atomic<int> count{0};
  return fmt::format("/twin-test-{}-{}", ::getpid(), count++);
}

/// The component's side of the memory, for tests without LinuxCNC.
class FakeShim {
 public:
  ~FakeShim() { leave(); }

  /// Attaches to the memory of a plant.
  void attach(const std::string& name) {
    file_ = ::shm_open(name.c_str(), O_RDWR | O_CLOEXEC, 0);
    ASSERT_GE(file_, 0) << name;
    hold();
  }
  /// Makes the memory of a controller, as twinctl does.
  void make(const std::string& name) {
    name_ = name;
    file_ = ::shm_open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_GE(file_, 0) << name;
    ASSERT_EQ(::ftruncate(file_, sizeof(twin_segment)), 0);
    hold();
    memory->version = TWIN_SEGMENT_VERSION;
    memory->size = sizeof(twin_segment);
    memory->use = TWIN_USE_CONTROLLER;
    memory->axes = 2;
    memory->axis[0].name[0] = 'x';
    memory->axis[1].name[0] = 'y';
    std::atomic_ref(memory->magic).store(TWIN_SEGMENT_MAGIC);
  }
  /// Lets the byte go and forgets the memory, as a component that was killed.
  void leave() {
    if (memory != nullptr) {
      ::munmap(memory, sizeof(twin_segment));
      ::close(file_);
      memory = nullptr;
    }
    if (!name_.empty()) {
      ::shm_unlink(name_.c_str());
      name_.clear();
    }
  }

  void ask() {
    ++memory->periods_asked;
    std::atomic_ref(memory->asked).fetch_add(1, std::memory_order_release);
    ::syscall(SYS_futex, &memory->asked, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
  }
  bool is_answered() const {
    return std::atomic_ref(memory->answered).load(std::memory_order_acquire) ==
           std::atomic_ref(memory->asked).load();
  }
  /// @returns whether the answer came within the time
  bool wait(std::chrono::milliseconds patience = std::chrono::seconds(5)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!is_answered()) {
      if (std::chrono::steady_clock::now() > end) {
        return false;
      }
      std::this_thread::yield();
    }
    return true;
  }
  bool pass_period() {
    ask();
    return wait();
  }

  twin_segment* memory = nullptr;

 private:
  void hold() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = TWIN_LOCK_SHIM;
    lock.l_len = 1;
    ASSERT_EQ(::fcntl(file_, F_OFD_SETLK, &lock), 0);
    memory = static_cast<twin_segment*>(
        ::mmap(nullptr, sizeof(twin_segment), PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0));
    ASSERT_NE(memory, MAP_FAILED);
    memory->shim = ::getpid();
  }

  int file_ = -1;
  std::string name_;  // of a memory that this has made
};

}  // namespace twin::test
