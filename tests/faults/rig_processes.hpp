#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child.hpp"
#include "tests/support/files.hpp"
#include "tests/support/guard_view.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::test {

/// Emulator and controller as two programs on the wall clock.
class RigProcesses {
 public:
  RigProcesses() {
    static int count = 0;
    name_ = "/twin-test-" + std::to_string(getpid()) + "-" + std::to_string(count++);
    for (const char* part : {"plant", "control"}) {
      std::filesystem::create_directory(folder_ / part);
    }
    folder_.put("control/long.nc", "G01 F1200 X80\nX-80\nX80\nX-80\nM30\n");
    folder_.put("control/short.nc", "G01 F1200 X10\nX0 Y10\nX0 Y0\nM30\n");
  }
  ~RigProcesses() {
    controller.reset();
    emulator.reset();
    unlink(("/dev/shm" + name_).c_str());
  }

  void start_emulator() {
    emulator = std::make_unique<Child>(
        std::vector<std::string>{"rig", "emulate", "--rig-name", name_, "--for", "120"},
        Child::Options{folder_ / "plant", {}});
    ASSERT_TRUE(becomes([&] { return !log().empty() && has_memory(); })) << log();
  }

  /// Starts a run against the emulator.
  /// @param more  further arguments
  void start_controller(const std::string& program, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",   program,   "--hal",      "rig",
                                       "--rig", "process", "--rig-name", name_,
                                       "--out", "out",     "--no-plots", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    controller = std::make_unique<Child>(arguments, Child::Options{folder_ / "control", {}});
  }

  /// Waits until the path is under way.
  bool waits_for_motion() const {
    return becomes([&] {
             return content_if_there(folder_ / "control/out/trace.partial.csv").size() > 20000 ||
                    has_ended();
           }) &&
           !has_ended();
  }
  /// What the controller has written on stderr so far.
  std::string complaint() const { return content_if_there(folder_ / "control/child.err"); }

  /// What the emulator has told so far.
  std::string log() const { return content_if_there(folder_ / "plant/child.out"); }

  /// When something was first told after a time, both on CLOCK_MONOTONIC [s].
  std::optional<double> time_of(const std::string& text, double after) const {
    // plant 0.493750 s, clock 24466.152719818 s: DAC 0 at 0x8000
    const std::string clock = "clock ";
    std::istringstream lines(log());
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find(clock);
      if (at == std::string::npos || !line.ends_with(" s: " + text)) {
        continue;
      }
      const double time = std::stod(line.substr(at + clock.size()));
      if (time >= after) {
        return time;
      }
    }
    return std::nullopt;
  }

  /// Waits until both converters came to rest at 0x8000 and all outputs are off.
  /// @returns how long after a time the last of them was [s]; nothing if they never were
  std::optional<double> safe_after(double time) const {
    std::optional<double> last;
    becomes([&] {
      last.reset();
      for (const char* text : {"DAC 0 at 0x8000", "DAC 1 at 0x8000", "digital outputs 0x0000"}) {
        // A converter that happened to be at 0 V when the others were switched off is not told
        // again.
        const auto told = time_of(text, time);
        const bool is_dac = text[0] == 'D';
        if (!told && !(is_dac && log().rfind(text) > log().rfind(leaves(text)))) {
          return false;
        }
        last = std::max(last.value_or(0.0), told.value_or(time) - time);
      }
      return true;
    });
    return last;
  }

  static bool becomes(const std::function<bool()>& is_so, int milliseconds = 20000) {
    for (int i = 0; i < milliseconds / 5; ++i) {
      if (is_so()) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  std::filesystem::path results() const { return folder_ / "control/out"; }
  const std::string& name() const { return name_; }

  std::unique_ptr<Child> emulator;
  std::unique_ptr<Child> controller;

 private:
  bool has_ended() const {
    return log().find("left") != std::string::npos || log().find("died") != std::string::npos;
  }
  static std::string leaves(const std::string& at_zero) { return at_zero.substr(0, 5) + " leaves"; }
  bool has_memory() const {
    struct stat status {};
    return stat(("/dev/shm" + name_).c_str(), &status) == 0 && status.st_size > 0 &&
           log().find("process") != std::string::npos;
  }
  static std::string content_if_there(const std::filesystem::path& file) {
    std::error_code missing;
    return std::filesystem::exists(file, missing) ? content(file) : std::string();
  }

  TempFolder folder_;
  std::string name_;
};

/// Limits so wide that a system that stands still for a while ends no run.
inline const std::vector<std::string> kPatient{"--set", "safety.runaway=50",
                                               "--set", "safety.frozen_encoder=50",
                                               "--set", "safety.tracking_error=50",
                                               "--set", "realtime.max_stall_ms=10000",
                                               "--set", "realtime.max_late_periods=10000",
                                               "--set", "safety.heartbeat_timeout_ms=5000"};

}  // namespace twin::test
