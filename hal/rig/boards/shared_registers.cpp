#include "hal/rig/boards/shared_registers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <new>
#include <thread>
#include <utility>

#include "core/descriptor.hpp"

namespace twin::hal::rig::boards {
namespace {

using namespace std::chrono_literals;

static_assert(std::atomic<double>::is_always_lock_free && std::atomic<float>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);

constexpr mode_t kOwnerOnly = 0600;
constexpr int kMostAttempts = 20;  // against processes that come and go at the same time
constexpr const char* kStart = "start one with 'twin rig emulate'";

tl::unexpected<Error> refused(const std::string& name, const char* what) {
  return fail(ErrorCode::kMachine,
              fmt::format("shared memory {} cannot be {}: {}", name, what, std::strerror(errno)));
}

SharedBlock* map(int file) noexcept {
  void* memory = ::mmap(nullptr, sizeof(SharedBlock), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<SharedBlock*>(memory);
}

off_t size_of(int file) noexcept {
  struct stat status {};
  return ::fstat(file, &status) == 0 ? status.st_size : 0;
}

/// Process that a block names, whatever its version; 0 where it cannot be told.
pid_t emulator_of(int file) noexcept {
  if (size_of(file) < static_cast<off_t>(sizeof(SharedBlock))) {
    return 0;
  }
  SharedBlock* block = map(file);
  const pid_t process = block != nullptr ? block->emulator.load() : 0;
  if (block != nullptr) {
    ::munmap(block, sizeof(SharedBlock));
  }
  return process;
}

/// Locked new memory under a name, taken over where a dead emulator left it; -1: somebody has it.
int lock_new(const std::string& name) noexcept {
  Descriptor file(::shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL, kOwnerOnly));
  if (file.get() >= 0) {
    return ::flock(file.get(), LOCK_EX | LOCK_NB) == 0 ? file.release() : -1;
  }
  const Descriptor stale(errno == EEXIST ? ::shm_open(name.c_str(), O_RDWR, 0) : -1);
  if (stale.get() >= 0 && ::flock(stale.get(), LOCK_EX | LOCK_NB) == 0) {
    struct stat status {};
    if (::fstat(stale.get(), &status) == 0 && status.st_nlink > 0) {
      ::shm_unlink(name.c_str());
    }
  }
  return -1;
}

/// Why memory cannot be used by a controller, or nothing.
Expected<void> check_block(const std::string& name, int file) {
  if (size_of(file) != static_cast<off_t>(sizeof(SharedBlock))) {
    return fail(ErrorCode::kMachine,
                fmt::format("shared memory {} is not that of this version of the program: "
                            "{} bytes in place of {}",
                            name, size_of(file), sizeof(SharedBlock)));
  }
  if (::flock(file, LOCK_SH | LOCK_NB) == 0) {  // nobody holds it
    ::flock(file, LOCK_UN);
    return fail(ErrorCode::kMachine,
                fmt::format("the emulator of shared memory {}, process {}, is dead; {}", name,
                            emulator_of(file), kStart));
  }
  return {};
}

Expected<void> check_version(const std::string& name, const SharedBlock& block) {
  const std::uint64_t magic = block.magic.load(std::memory_order_acquire);
  const std::uint32_t version = block.version.load();
  if (magic == 0) {
    return fail(ErrorCode::kMachine,
                fmt::format("the emulator of shared memory {}, process {}, is still starting", name,
                            block.emulator.load()));
  }
  if (magic != kSharedMagic || version != kSharedVersion) {
    return fail(ErrorCode::kMachine,
                fmt::format("shared memory {} is not that of this program: magic {:x}, version {} "
                            "in place of {:x}, {}",
                            name, magic, version, kSharedMagic, kSharedVersion));
  }
  return {};
}

/// Makes this process the controller, in place of one that ended without saying so.
Expected<void> take_control(SharedBlock& block) {
  pid_t other = block.controller.load();
  while (other == 0 || !is_running(other)) {
    if (block.controller.compare_exchange_strong(other, ::getpid())) {
      return {};
    }
  }
  return fail(ErrorCode::kMachine,
              fmt::format("process {} drives the emulated rig already", other));
}

}  // namespace

std::string default_shared_name() { return fmt::format("/twin-rig-{}", ::getuid()); }

SharedRegisters::SharedRegisters(std::string name, int file, SharedBlock* block,
                                 pid_t owner) noexcept
    : name_(std::move(name)), file_(file), block_(block), owner_(owner) {}

Expected<std::unique_ptr<SharedRegisters>> SharedRegisters::create(const std::string& name) {
  int locked = -1;
  for (int i = 0; i < kMostAttempts && locked < 0; ++i) {
    locked = lock_new(name);
    if (locked < 0 && errno != EEXIST && errno != EWOULDBLOCK && errno != ENOENT) {
      return refused(name, "made");
    }
    if (locked < 0) {
      std::this_thread::sleep_for(2ms);
    }
  }
  if (locked < 0) {
    const Descriptor other(::shm_open(name.c_str(), O_RDWR, 0));
    return fail(ErrorCode::kMachine,
                fmt::format("an emulator is running already, process {}, shared memory {}",
                            other.get() >= 0 ? emulator_of(other.get()) : 0, name));
  }
  Descriptor file(locked);
  if (::ftruncate(file.get(), sizeof(SharedBlock)) != 0) {
    ::shm_unlink(name.c_str());
    return refused(name, "made large enough");
  }
  SharedBlock* block = map(file.get());
  if (block == nullptr) {
    ::shm_unlink(name.c_str());
    return refused(name, "mapped");
  }
  new (block) SharedBlock;
  block->version.store(kSharedVersion);
  block->emulator.store(::getpid());
  std::unique_ptr<SharedRegisters> shared(
      new SharedRegisters(name, file.release(), block, ::getpid()));
  shared->is_emulator_ = true;
  return shared;
}

Expected<std::unique_ptr<SharedRegisters>> SharedRegisters::attach(const std::string& name,
                                                                   SharedRole role) {
  Descriptor file(::shm_open(name.c_str(), O_RDWR, 0));
  if (file.get() < 0) {
    return errno == ENOENT
               ? fail(ErrorCode::kMachine,
                      fmt::format("no emulator is running (no shared memory {}); {}", name, kStart))
               : refused(name, "opened");
  }
  TWIN_CHECK(check_block(name, file.get()));
  SharedBlock* block = map(file.get());
  if (block == nullptr) {
    return refused(name, "mapped");
  }
  std::unique_ptr<SharedRegisters> shared(
      new SharedRegisters(name, file.release(), block, ::getpid()));
  Expected<void> joined = check_version(name, *block);
  if (joined && role == SharedRole::kController) {
    joined = take_control(*block);
    shared->is_controller_ = joined.has_value();
  }
  if (!joined) {
    return tl::unexpected<Error>(joined.error());
  }
  return shared;
}

SharedRegisters::~SharedRegisters() {
  if (is_emulator_ && owner_ == ::getpid()) {
    block_->has_ended.store(true);
    block_->boards.pci1716.is_present.store(false);
    block_->boards.pci1784.is_present.store(false);
    ::shm_unlink(name_.c_str());
  }
  if (is_controller_ && owner_ == ::getpid()) {
    pid_t self = owner_;
    block_->controller.compare_exchange_strong(self, 0);
  }
  ::munmap(block_, sizeof(SharedBlock));
  ::close(file_);
}

bool is_running(pid_t process) noexcept {
  const auto handle = static_cast<int>(::syscall(SYS_pidfd_open, process, 0));
  if (handle < 0) {
    return errno != ESRCH && ::kill(process, 0) == 0;
  }
  pollfd ended{handle, POLLIN, 0};
  const bool has_ended = ::poll(&ended, 1, 0) > 0;
  ::close(handle);
  return !has_ended;
}

}  // namespace twin::hal::rig::boards
