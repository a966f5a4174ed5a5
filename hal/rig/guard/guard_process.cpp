#include "hal/rig/guard/guard_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include "core/descriptor.hpp"
#include "hal/rig/guard/guard_protocol.hpp"

namespace twin::hal::rig::guard {
namespace {

using namespace std::chrono_literals;

constexpr auto kStartTime = 10s;  // to open the card, on a machine that is busy

tl::unexpected<Error> failed(const char* what, int code) {
  return fail(ErrorCode::kMachine,
              fmt::format("the guard process cannot be started: {}: {}", what, strerror(code)));
}

/// Makes a mutex whose holder's death is told to whoever waits for it, in any process, and holds
/// it.
void own(pthread_mutex_t& mutex) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
  pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST);
  pthread_mutex_init(&mutex, &attributes);
  pthread_mutexattr_destroy(&attributes);
  pthread_mutex_lock(&mutex);
}

/// Attributes of a process in a session of its own, with no signal blocked and no output.
class Spawn {
 public:
  Spawn() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_,
                             static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSID));
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_RDWR, 0);
    }
  }
  Spawn(const Spawn&) = delete;
  Spawn& operator=(const Spawn&) = delete;
  ~Spawn() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  /// Leaves a descriptor open in the new process, under the same number.
  void keep(int descriptor) { posix_spawn_file_actions_adddup2(&actions_, descriptor, descriptor); }

  /// @returns 0 or errno
  int start(pid_t& pid, const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) {
      argv.push_back(const_cast<char*>(argument.c_str()));  // posix_spawn does not change them
    }
    argv.push_back(nullptr);
    return posix_spawn(&pid, argv[0], &actions_, &attributes_, argv.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

Expected<void> GuardProcess::start(const GuardTarget& target) {
  if (page_ != nullptr) {
    return {};
  }
  auto started = spawn(target);
  if (started) {
    started = wait_until_watching();
  }
  if (!started) {
    end();
  }
  return started;
}

Expected<void> GuardProcess::spawn(const GuardTarget& target) {
  const Descriptor memory(memfd_create("twin-guard", MFD_CLOEXEC));
  if (memory.get() < 0 || ftruncate(memory.get(), sizeof(GuardPage)) != 0) {
    return failed("shared memory", errno);
  }
  void* const mapped =
      mmap(nullptr, sizeof(GuardPage), PROT_READ | PROT_WRITE, MAP_SHARED, memory.get(), 0);
  if (mapped == MAP_FAILED) {
    return failed("shared memory", errno);
  }
  page_ = new (mapped) GuardPage;
  own(page_->owner);
  std::array<int, 2> ends{-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    return failed("pipe", errno);
  }
  const Descriptor read_end(ends[0]);
  lifeline_ = ends[1];
  Spawn process;
  process.keep(memory.get());
  process.keep(read_end.get());
  std::vector<std::string> command =
      to_text(GuardArguments{.page = memory.get(),
                             .lifeline = read_end.get(),
                             .outputs = target.outputs,
                             .safe_digital = target.safe_digital,
                             .timeout_ms = static_cast<int>(target.timeout.count())});
  command.insert(command.begin(), target.program.string());
  const int code = process.start(pid_, command);
  if (code != 0) {
    pid_ = -1;
    return failed(target.program.c_str(), code);
  }
  return {};
}

Expected<void> GuardProcess::wait_until_watching() {
  const auto end = std::chrono::steady_clock::now() + kStartTime;
  while (std::chrono::steady_clock::now() < end) {
    switch (page_->state.load()) {
      case GuardState::kWatching:
      case GuardState::kActed:
        return {};
      case GuardState::kFailed:
        return fail(ErrorCode::kMachine,
                    fmt::format("the guard process failed: {}", page_->message.data()));
      case GuardState::kStarting:
        break;
    }
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = -1;
      return fail(ErrorCode::kMachine,
                  fmt::format("the guard process ended at once, {} {}",
                              WIFSIGNALED(status) ? "by signal" : "with status",
                              WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)));
    }
    std::this_thread::sleep_for(1ms);
  }
  return fail(ErrorCode::kMachine,
              fmt::format("the guard process did not open the card within {} s",
                          std::chrono::seconds(kStartTime).count()));
}

GuardProcess::~GuardProcess() {
  disarm();
  end();
}

void GuardProcess::end() noexcept {
  if (lifeline_ >= 0) {
    close(std::exchange(lifeline_, -1));
  }
  if (pid_ > 0) {
    waitpid(std::exchange(pid_, -1), nullptr, 0);
  }
  if (page_ != nullptr) {
    pthread_mutex_unlock(&page_->owner);
    munmap(std::exchange(page_, nullptr), sizeof(GuardPage));
  }
}

void GuardProcess::arm() noexcept {
  if (page_ != nullptr) {
    page_->is_armed.store(true, std::memory_order_release);
  }
}

void GuardProcess::beat() noexcept {
  if (page_ != nullptr) {
    page_->heartbeats.fetch_add(1, std::memory_order_relaxed);
  }
}

void GuardProcess::disarm() noexcept {
  if (page_ != nullptr) {
    page_->is_armed.store(false, std::memory_order_release);
  }
}

bool GuardProcess::has_acted() const noexcept {
  return page_ != nullptr && page_->state == GuardState::kActed;
}

bool GuardProcess::is_alive() noexcept {
  if (page_ == nullptr) {
    return true;
  }
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return !guard_timer_.is_late(now, page_->turns.load(std::memory_order_relaxed), true);
}

}  // namespace twin::hal::rig::guard
