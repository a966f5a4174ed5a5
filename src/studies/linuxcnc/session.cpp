#include "studies/linuxcnc/session.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "config/find_file.hpp"
#include "core/atomic_file.hpp"
#include "hal/linuxcnc/serve_plant.hpp"
#include "studies/linuxcnc/machine_config.hpp"
#include "studies/linuxcnc/recording.hpp"

extern char** environ;

namespace twin::studies::linuxcnc {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int kNotThere = 77;             // exit status of the sandbox where something is missing
constexpr const char* kNobody = "65534";  // user of LinuxCNC's real-time process where we are root

bool is_file(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

/// A plant in a thread of this process.
class PlantThread {
 public:
  PlantThread(const SessionRequest& request, const std::string& name)
      : recordings_(request.folder / "recordings", request.machine.period) {
    hal::linuxcnc::ServeSettings settings;
    settings.setup.table = request.machine.table;
    settings.setup.period = request.machine.period;
    settings.name = name;
    settings.started = [this](const std::string&) { is_up_.store(true); };
    settings.record = [this](const twin_segment& memory) { return recordings_.take(memory); };
    settings.left = [this] { return recordings_.end(); };
    thread_ = std::thread([this, settings] {
      auto served = hal::linuxcnc::serve_plant(settings, stop_, [](std::string_view) {});
      if (!served) {
        error_ = std::move(served).error();
      }
      has_ended_.store(true);
    });
  }
  PlantThread(const PlantThread&) = delete;
  PlantThread& operator=(const PlantThread&) = delete;
  ~PlantThread() { end(); }

  /// Waits until LinuxCNC may come.
  bool wait() const {
    while (!is_up_.load() && !has_ended_.load()) {
      std::this_thread::sleep_for(1ms);
    }
    return !has_ended_.load();
  }
  void end() {
    stop_.store(true);
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  const std::optional<Error>& error() const { return error_; }
  const std::vector<fs::path>& recordings() const { return recordings_.folders(); }

 private:
  Recordings recordings_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> is_up_{false};
  std::atomic<bool> has_ended_{false};
  std::optional<Error> error_;
  std::thread thread_;
};

Expected<void> write_files(const SessionRequest& request, const std::string& segment) {
  std::error_code error;
  for (const char* folder : {"config", "home", "recordings"}) {
    fs::create_directories(request.folder / folder, error);
    if (error) {
      return file_error(request.folder / folder, "make this folder", error.value());
    }
  }
  ConfigOptions options;
  options.is_homed_here = true;
  options.headless = request.installation.scripts / "headless";
  const fs::path folder = request.folder / "config";
  TWIN_CHECK(write_whole_file(folder / "twin.ini", ini_text(request.machine, options)));
  TWIN_CHECK(write_whole_file(folder / "twin.hal", hal_text(request.machine, segment)));
  TWIN_CHECK(write_whole_file(folder / "tool.tbl", "T1 P1 D1.0 Z0.0 ;pen\n"));
  return {};
}

std::string program_list(const SessionRequest& request) {
  std::string list;
  for (const fs::path& program : request.programs) {
    list += (list.empty() ? "" : ":") + fs::absolute(program).string();
  }
  return list;
}

/// Environment of the sandbox.
std::vector<std::string> environment_of(const SessionRequest& request) {
  std::vector<std::string> texts;
  for (char** text = environ; *text != nullptr; ++text) {
    texts.emplace_back(*text);
  }
  texts.push_back("TWIN_PROGRAMS=" + program_list(request));
  if (request.hurry > 1.0 && !request.installation.hurry.empty()) {
    texts.push_back("LD_PRELOAD=" + request.installation.hurry.string());
    texts.push_back(fmt::format("TWIN_HURRY={:g}", request.hurry));
  }
  return texts;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

/// Starts the sandbox; its output goes to the log.
Expected<pid_t> start(const SessionRequest& request) {
  const fs::path& scripts = request.installation.scripts;
  std::vector<std::string> words{
      (scripts / "sandbox").string(), request.installation.modules.string(),
      fs::absolute(request.folder / "home").string(), (scripts / "start").string(),
      fs::absolute(request.folder / "config" / "twin.ini").string()};
  std::vector<std::string> texts = environment_of(request);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const std::string log = (request.folder / "log").string();
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = -1;
  const int failed = ::posix_spawn(&process, words.front().c_str(), &files, nullptr,
                                   pointers_to(words).data(), pointers_to(texts).data());
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) {
    return file_error(words.front(), "be started", failed);
  }
  return process;
}

/// Waits for the end of LinuxCNC; its exit status, or why it had to be ended.
Expected<int> wait_for_end(pid_t process, const SessionRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  const auto limit = std::chrono::duration<double>(request.time_limit);
  for (;;) {
    int status = 0;
    if (::waitpid(process, &status, WNOHANG) == process) {
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    const bool is_stopped = request.stop != nullptr && request.stop->load();
    const bool is_too_long = std::chrono::steady_clock::now() - start > limit;
    if (is_stopped || is_too_long) {
      ::kill(process, SIGKILL);  // its namespace of processes goes with it
      ::waitpid(process, &status, 0);
      return is_stopped ? fail(ErrorCode::kInterrupted, "interrupted")
                        : fail(ErrorCode::kMachine,
                               fmt::format("LinuxCNC has not ended within {:.0f} s; see {}",
                                           request.time_limit, (request.folder / "log").string()));
    }
    std::this_thread::sleep_for(20ms);
  }
}

/// The last lines of the log that say what failed.
std::string last_words(const fs::path& log) {
  std::ifstream in(log);
  std::string line;
  std::string told;
  while (std::getline(in, line)) {
    const std::size_t at = line.find("headless: ");
    if (at != std::string::npos) {
      told = line.substr(at + std::strlen("headless: "));
    } else if (line.find("twin.hal:") != std::string::npos) {
      told = line;  // halcmd, about a line of the HAL file
    } else if (line.find("sandbox: ") == 0) {
      told = line.substr(std::strlen("sandbox: "));
    }
  }
  return told;
}

}  // namespace

Expected<Installation> find_installation() {
  Installation found;
  for (const fs::path& folder : config::data_folders("hal/linuxcnc/shim")) {
    if (found.scripts.empty() && is_file(folder / "sandbox")) {
      found.scripts = fs::absolute(folder);
    }
  }
  for (const fs::path& folder : config::data_folders("linuxcnc")) {
    if (found.modules.empty() && is_file(folder / "modules" / "twin.so")) {
      found.modules = fs::absolute(folder / "modules");
      found.hurry = is_file(folder / "hurry.so") ? fs::absolute(folder / "hurry.so") : fs::path();
    }
  }
  if (!is_file("/usr/bin/rtapi_app") || !is_file("/usr/bin/linuxcnc")) {
    return fail(ErrorCode::kMachine,
                "LinuxCNC is not installed: Debian's package is linuxcnc-uspace");
  }
  if (found.modules.empty()) {
    return fail(ErrorCode::kMachine,
                "the components for LinuxCNC's HAL are not built: install linuxcnc-uspace-dev and "
                "build anew");
  }
  if (found.scripts.empty()) {
    return fail(ErrorCode::kMachine, "the scripts of hal/linuxcnc/shim are not there");
  }
  return found;
}

Expected<SessionResult> run_linuxcnc(const SessionRequest& request) {
  const std::string segment = fmt::format("/twin-plant-of-{}", ::getpid());
  if (::geteuid() == 0) {
    ::setenv("RTAPI_UID", kNobody, 0);
  }
  TWIN_CHECK(write_files(request, segment));
  PlantThread plant(request, segment);
  if (!plant.wait()) {
    plant.end();
    return tl::unexpected(*plant.error());
  }
  TWIN_TRY(const pid_t process, start(request));
  const Expected<int> status = wait_for_end(process, request);
  plant.end();
  if (!status) {
    return tl::unexpected(status.error());
  }
  if (plant.error()) {
    return tl::unexpected(*plant.error());
  }
  SessionResult result{plant.recordings(), *status, {}};
  if (*status != 0) {
    for (const char* log : {"home/linuxcnc_debug.txt", "home/linuxcnc_print.txt", "log"}) {
      const std::string told = last_words(request.folder / log);
      result.told = told.empty() ? result.told : told;
    }
    if (*status == kNotThere) {
      return fail(ErrorCode::kMachine, result.told);
    }
  }
  return result;
}

}  // namespace twin::studies::linuxcnc
