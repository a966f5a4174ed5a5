#include "hal/linuxcnc/shared_segment.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/descriptor.hpp"
#include "core/wall_clock.hpp"

namespace twin::hal::linuxcnc {
namespace {

constexpr mode_t kOwnerOnly = 0600;
constexpr const char* kNoShim =
    "load the component into LinuxCNC's HAL: loadrt twinctl, in a HAL file";

flock lock_of(int byte, short type) noexcept {
  flock lock{};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  return lock;
}

/// Holds a byte of the file as long as it is open; false if another process holds it.
bool take_byte(int file, int byte) noexcept {
  flock lock = lock_of(byte, F_WRLCK);
  return ::fcntl(file, F_OFD_SETLK, &lock) == 0;
}

bool is_taken(int file, int byte) noexcept {
  flock lock = lock_of(byte, F_WRLCK);
  return ::fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

tl::unexpected<Error> cannot(const std::string& name, const char* what) {
  return fail(ErrorCode::kMachine,
              fmt::format("shared memory {} cannot be {}: {}", name, what, std::strerror(errno)));
}

/// Whether the file is this user's alone.
Expected<void> check_owner(const std::string& name, int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0) {
    return cannot(name, "looked at");
  }
  if (status.st_uid != segment_owner() && status.st_uid != ::geteuid()) {
    return fail(ErrorCode::kMachine,
                fmt::format("shared memory {} belongs to user {}, not to user {}", name,
                            status.st_uid, segment_owner()));
  }
  if ((status.st_mode & 077U) != 0) {
    return fail(ErrorCode::kMachine,
                fmt::format("shared memory {} has mode {:03o}: others than its owner can use it",
                            name, status.st_mode & 0777U));
  }
  return {};
}

/// What is in the file, without mapping it: the fields that tell whether it can be mapped.
struct Head {
  std::uint64_t magic = 0;
  std::uint32_t version = 0;
  std::uint32_t size = 0;
  std::uint32_t use = 0;
};

bool is_current(int file, std::uint32_t use) noexcept {
  Head head;
  struct stat status {};
  return ::fstat(file, &status) == 0 && status.st_size == off_t{sizeof(twin_segment)} &&
         ::pread(file, &head, sizeof head, 0) == ssize_t{sizeof head} &&
         head.magic == TWIN_SEGMENT_MAGIC && head.version == TWIN_SEGMENT_VERSION &&
         head.size == sizeof(twin_segment) && head.use == use;
}

tl::unexpected<Error> wrong_version(const std::string& name, int file) {
  Head head;
  const ssize_t got = ::pread(file, &head, sizeof head, 0);
  return fail(ErrorCode::kMachine,
              fmt::format("the component at {} is of another version of twin: version {}, {} bytes "
                          "in place of {}, {}; build it anew",
                          name, got < 0 ? 0 : head.version, got < 0 ? 0 : head.size,
                          TWIN_SEGMENT_VERSION, sizeof(twin_segment)));
}

void unlink_segment(const std::string& name) noexcept { ::shm_unlink(name.c_str()); }

/// Makes a file that nobody has, for its owner alone.
Expected<Descriptor> make_file(const std::string& name) {
  Descriptor file(::shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerOnly));
  if (file.get() < 0) {
    return cannot(name, "made");
  }
  const bool is_made = ::ftruncate(file.get(), sizeof(twin_segment)) == 0 &&
                       take_byte(file.get(), TWIN_LOCK_PROGRAM);
  if (!is_made || (::geteuid() == 0 && segment_owner() != 0 &&
                   ::fchown(file.get(), segment_owner(), gid_t(-1)) != 0)) {
    const auto error = cannot(name, "made");
    unlink_segment(name);
    return error;
  }
  return file;
}

}  // namespace

uid_t segment_owner() noexcept {
  const char* const text = ::geteuid() == 0 ? std::getenv("RTAPI_UID") : nullptr;
  unsigned user = 0;
  if (text != nullptr) {
    const std::string_view given(text);
    if (std::from_chars(given.data(), given.data() + given.size(), user).ec == std::errc{}) {
      return user;
    }
  }
  return ::geteuid();
}

std::string default_segment_name(Role role) {
  return fmt::format("/twin-{}-{}", role == Role::kPlant ? "plant" : "controller", segment_owner());
}

SharedSegment::SharedSegment(std::string name, int file, twin_segment* segment, Role role) noexcept
    : name_(std::move(name)), file_(file), segment_(segment), role_(role) {}

Expected<std::unique_ptr<SharedSegment>> SharedSegment::map(const std::string& name, int file,
                                                            Role role) {
  void* memory = ::mmap(nullptr, sizeof(twin_segment), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) {
    return cannot(name, "mapped");
  }
  return std::unique_ptr<SharedSegment>(
      new SharedSegment(name, file, static_cast<twin_segment*>(memory), role));
}

Expected<std::unique_ptr<SharedSegment>> SharedSegment::make_plant(const std::string& name) {
  Descriptor file(::shm_open(name.c_str(), O_RDWR | O_CLOEXEC, 0));
  if (file.get() < 0 && errno != ENOENT) {
    return cannot(name, "opened");
  }
  if (file.get() >= 0) {
    TWIN_CHECK(check_owner(name, file.get()));
    if (!take_byte(file.get(), TWIN_LOCK_PROGRAM)) {
      return fail(ErrorCode::kMachine, fmt::format("a plant is running already, at {}", name));
    }
    if (!is_current(file.get(), TWIN_USE_PLANT)) {
      if (is_taken(file.get(), TWIN_LOCK_SHIM)) {
        return wrong_version(name, file.get());
      }
      unlink_segment(name);
      file = Descriptor();
    }
  }
  if (file.get() < 0) {
    TWIN_TRY(file, make_file(name));
  }
  TWIN_TRY(std::unique_ptr<SharedSegment> made, map(name, file.get(), Role::kPlant));
  file.release();
  made->memory().version = TWIN_SEGMENT_VERSION;
  made->memory().size = sizeof(twin_segment);
  made->memory().use = TWIN_USE_PLANT;
  made->memory().program = ::getpid();
  return made;
}

Expected<std::unique_ptr<SharedSegment>> SharedSegment::attach_controller(const std::string& name) {
  Descriptor file(::shm_open(name.c_str(), O_RDWR | O_CLOEXEC, 0));
  if (file.get() < 0) {
    return errno == ENOENT
               ? fail(ErrorCode::kMachine,
                      fmt::format("no LinuxCNC is there for us (no shared memory {}); {}", name,
                                  kNoShim))
               : cannot(name, "opened");
  }
  TWIN_CHECK(check_owner(name, file.get()));
  if (!is_taken(file.get(), TWIN_LOCK_SHIM)) {
    return fail(
        ErrorCode::kMachine,
        fmt::format("shared memory {} was left by a LinuxCNC that has ended; {}", name, kNoShim));
  }
  if (!is_current(file.get(), TWIN_USE_CONTROLLER)) {
    return wrong_version(name, file.get());
  }
  if (!take_byte(file.get(), TWIN_LOCK_PROGRAM)) {
    return fail(ErrorCode::kMachine,
                fmt::format("another controller drives LinuxCNC's machine already, at {}", name));
  }
  TWIN_TRY(std::unique_ptr<SharedSegment> attached, map(name, file.get(), Role::kController));
  file.release();
  attached->memory().program = ::getpid();
  return attached;
}

SharedSegment::~SharedSegment() {
  if (role_ == Role::kPlant && !has_shim()) {
    unlink_segment(name_);
  }
  ::munmap(segment_, sizeof(twin_segment));
  ::close(file_);
}

void SharedSegment::publish() noexcept {
  std::atomic_ref(segment_->magic).store(TWIN_SEGMENT_MAGIC, std::memory_order_release);
}

bool SharedSegment::has_shim() const noexcept { return is_taken(file_, TWIN_LOCK_SHIM); }

bool SharedSegment::wait_for_question(std::int64_t patience) noexcept {
  const std::int64_t end = monotonic_ns() + patience;
  const std::atomic_ref asked(segment_->asked);
  const std::atomic_ref answered(segment_->answered);
  for (;;) {
    const std::uint32_t seen = asked.load(std::memory_order_acquire);
    if (seen != answered.load(std::memory_order_relaxed)) {
      return true;
    }
    if (monotonic_ns() >= end) {
      return false;
    }
    const timespec until = timespec_of(end);
    ::syscall(SYS_futex, &segment_->asked, FUTEX_WAIT_BITSET, seen, &until, nullptr,
              FUTEX_BITSET_MATCH_ANY);
  }
}

void SharedSegment::answer() noexcept {
  const std::atomic_ref answered(segment_->answered);
  answered.store(std::atomic_ref(segment_->asked).load(std::memory_order_relaxed),
                 std::memory_order_release);
  ::syscall(SYS_futex, &segment_->answered, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

void SharedSegment::drop_question() noexcept { answer(); }

}  // namespace twin::hal::linuxcnc
