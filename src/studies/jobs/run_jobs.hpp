#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "hal/machine.hpp"
#include "results/metrics/summary.hpp"
#include "results/trace/trace_files.hpp"

/// Several runs side by side over the cores.
namespace twin::studies::jobs {

/// One run among several.
struct Job {
  std::string name;  ///< in front of its errors, as in "oxalis.nc, nurbs"
  gcode::ProgramText program;
  config::MachineFile machine;
  std::optional<double> feedrate;   ///< replaces the program's F words [mm/s]
  std::filesystem::path directory;  ///< of its results; no other job has it
  bool has_machine = true;          ///< else it is planned only
  bool keeps_results = true;        ///< else the folder is removed at its end
};

/// Makes the machine a job runs on, unconfigured. Called from several threads.
using MakeMachine = std::function<std::unique_ptr<hal::Machine>(const config::MachineFile&)>;

/// How jobs are run.
struct Options {
  MakeMachine make_machine;
  const std::atomic<bool>* stop = nullptr;  ///< set to end early
  std::function<void(double)> progress{};   ///< gets the done share, 0 to 1; one call at a time
  results::TraceFiles trace = results::TraceFiles::kCsv;  ///< as which files traces are written
};

/// Runs the jobs, as many at a time as there are cores. Each runs in lockstep, so that its results
/// do not depend on what runs beside it.
///
/// After a failure no job behind the failed one is begun.
///
/// @returns the summaries in the order of the jobs; or the error, with the job's name, of the first
/// job in that order that fails, which does not depend on what runs beside it either
Expected<std::vector<results::Summary>> run_jobs(std::span<const Job> jobs, const Options& options);

}  // namespace twin::studies::jobs
