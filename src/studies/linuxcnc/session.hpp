#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::studies::linuxcnc {

/// Where the files are that a headless LinuxCNC needs besides its own.
struct Installation {
  std::filesystem::path scripts;  ///< folder of sandbox, start and headless
  std::filesystem::path modules;  ///< folder of the components; empty: they are not built
  std::filesystem::path hurry;    ///< preload that makes threads sleep less; empty: there is none
};

/// Finds them. An error says what is missing: LinuxCNC, its headers at build time, or the scripts.
Expected<Installation> find_installation();

/// LinuxCNC without a display on a plant of this process, in namespaces of its own.
struct SessionRequest {
  Installation installation;
  config::MachineFile machine;
  std::vector<std::filesystem::path> programs;  ///< run one after the other, each from zero
  std::filesystem::path folder;                 ///< for configuration, recordings and log
  double time_limit = 600.0;                    ///< of the wall clock [s]
  double hurry = 1.0;                           ///< how much faster than the wall clock it may go
  const std::atomic<bool>* stop = nullptr;
};

/// What it has left.
struct SessionResult {
  std::vector<std::filesystem::path> recordings;  ///< a folder each, in order
  int status = 0;                                 ///< of LinuxCNC
  std::string told;                               ///< its last words where it failed
};

/// Starts LinuxCNC, homes it where the table stands, runs the programs, and ends it.
Expected<SessionResult> run_linuxcnc(const SessionRequest& request);

}  // namespace twin::studies::linuxcnc
