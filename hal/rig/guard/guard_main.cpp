#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <string>

#include "hal/rig/guard/guard_loop.hpp"
#include "hal/rig/guard/guarded_outputs.hpp"

// twin-guard: started by the controller, never by hand. Exit status 0 when the controller has
// ended.
namespace {

using namespace twin::hal::rig::guard;

struct Options {
  int page = -1;
  int lifeline = -1;
  std::string outputs;
  unsigned safe_digital = 0;
  int timeout_ms = 20;
};

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

int guard(const Options& options) {
  void* const mapped =
      mmap(nullptr, sizeof(GuardPage), PROT_READ | PROT_WRITE, MAP_SHARED, options.page, 0);
  if (mapped == MAP_FAILED) {
    return 1;
  }
  auto& page = *static_cast<GuardPage*>(mapped);
  auto make_safe = open_guarded_outputs(options.outputs, options.safe_digital);
  if (!make_safe) {
    report_failure(page, to_string(make_safe.error()));
    return 1;
  }
  take_priority();
  run_guard(page, options.lifeline, std::chrono::milliseconds(options.timeout_ms), *make_safe);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  ignore_signals();
  CLI::App app("twin-guard: makes the rig's outputs safe when its controller is gone or silent",
               "twin-guard");
  Options options;
  app.add_option("--page", options.page, "Shared memory")->required();
  app.add_option("--lifeline", options.lifeline, "Read end of a pipe of the controller")
      ->required();
  app.add_option("--outputs", options.outputs, "Where the outputs are")->required();
  app.add_option("--safe-digital", options.safe_digital, "Digital outputs with the servos off");
  app.add_option("--timeout-ms", options.timeout_ms, "Longest silence");
  CLI11_PARSE(app, argc, argv);
  return guard(options);
} catch (const std::exception&) {
  return 1;
}
