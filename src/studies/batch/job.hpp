#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "results/trace/trace_files.hpp"
#include "runtime/override_schedule.hpp"

/// Many runs: each is a value with a key, and its results lie in a store under that key.
namespace twin::studies::batch {

/// What kind of machine a job moves.
enum class JobMachine {
  kTable,  ///< "mujoco", the simulated table
  kIdeal,  ///< "ideal", whose position is the set point
  kNone,   ///< "none": the program is planned only
};

/// The name of a machine as job files have it.
const char* name_of(JobMachine machine) noexcept;

/// One run as it is asked for: a line of a job file.
struct Job {
  std::string program;                    ///< file, or name in nc_programs
  std::string machine = "xy_table.toml";  ///< machine file, or name in mjcf
  std::vector<std::string> settings;      ///< KEY=VALUE, applied in order
  std::optional<double> feedrate;         ///< replaces the program's F words [mm/s]
  JobMachine hal = JobMachine::kTable;
  std::vector<runtime::OverrideChange> overrides;
  results::TraceFiles trace = results::TraceFiles::kNone;  ///< files of it that the store gets
};

/// A job with everything that its result depends on, and the key that follows from that.
struct PreparedJob {
  Job job;
  gcode::ProgramText program;
  config::MachineFile machine;
  /// JSON with sorted keys: checksum of the program, all settings as used, checksum of the MJCF
  /// model, options, version of twin. Names and places of files are not part of it.
  std::string canonical;
  std::string key;  ///< SHA-256 of `canonical`, 64 hexadecimal digits
};

/// Reads programs and machine files for jobs, each program once.
class JobMaker {
 public:
  /// @returns the job with its key, or the error of its program's file or of its settings
  Expected<PreparedJob> prepare(const Job& job);

 private:
  Expected<gcode::ProgramText> program(const std::string& name);
  Expected<std::string> model_checksum(const std::filesystem::path& model);

  std::map<std::string, gcode::ProgramText> programs_;
  std::map<std::string, std::string> models_;
};

}  // namespace twin::studies::batch
