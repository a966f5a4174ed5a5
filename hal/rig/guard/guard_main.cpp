#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <span>
#include <string>

#include "hal/rig/guard/guard.hpp"
#include "hal/rig/guard/guard_protocol.hpp"

// twin-guard makes the rig's outputs safe when its controller is gone or silent. The controller
// starts it, never a user. Its exit status is 0 when the controller has ended.
namespace {

using namespace twin::hal::rig::guard;

/// Nothing that a terminal or a session sends ends the guard.
void ignore_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP, SIGTTIN, SIGTTOU}) {
    ::signal(signal, SIG_IGN);
  }
}

/// Above the controller, whose hanging it must survive; as far as the system allows it.
void take_priority() {
  sched_param priority{};
  priority.sched_priority = sched_get_priority_max(SCHED_FIFO) - 1;
  sched_setscheduler(0, SCHED_FIFO, &priority);
  mlockall(MCL_CURRENT | MCL_FUTURE);
}

void report_failure(GuardPage& page, const std::string& message) {
  const std::size_t size = std::min(message.size(), page.message.size() - 1);
  std::copy_n(message.begin(), size, page.message.begin());
  page.state = GuardState::kFailed;
}

int guard_outputs(const GuardArguments& arguments) {
  void* const mapped =
      mmap(nullptr, sizeof(GuardPage), PROT_READ | PROT_WRITE, MAP_SHARED, arguments.page, 0);
  if (mapped == MAP_FAILED) {
    return 1;
  }
  auto& page = *static_cast<GuardPage*>(mapped);
  auto make_safe = open_guarded_outputs(arguments.outputs, arguments.safe_digital);
  if (!make_safe) {
    report_failure(page, twin::to_string(make_safe.error()));
    return 1;
  }
  take_priority();
  run_guard(page, arguments.lifeline, std::chrono::milliseconds(arguments.timeout_ms), *make_safe);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  ignore_signals();
  const std::span<const char* const> texts(argv, static_cast<std::size_t>(argc));
  const auto arguments = parse_guard_arguments(texts.subspan(1));
  if (!arguments) {
    std::fprintf(stderr, "twin-guard: %s; only twin starts it\n",
                 twin::to_string(arguments.error()).c_str());
    return twin::exit_status(arguments.error());
  }
  return guard_outputs(*arguments);
} catch (const std::exception&) {
  return 1;
}
