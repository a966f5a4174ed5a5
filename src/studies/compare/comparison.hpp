#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/limits.hpp"
#include "gcode/program_text.hpp"
#include "studies/compare/bounded_plan.hpp"
#include "studies/jobs/run_jobs.hpp"

/// Planners and interpolators side by side.
namespace twin::studies::compare {

/// What is compared, and on which machine.
struct Request {
  gcode::ProgramText program;
  std::vector<gcode::ProgramText> curve_programs;  ///< further ones, for the fluctuation alone
  std::filesystem::path machine_file;
  std::vector<std::string> settings;  ///< section.key=value, for all
  std::optional<double> feedrate;     ///< replaces the program's F words [mm/s]
  std::filesystem::path folder;       ///< exists; gets a folder with the trace of each run
  studies::jobs::Options running;
};

/// One run: an interpolator under the paper's planner, or the certified planner.
struct Contestant {
  std::string name;              ///< "nurbs", "bezier", "linear", "certified"
  std::string planner;           ///< "paper", "certified"
  results::Summary summary;      ///< with planning time and bound
  std::filesystem::path folder;  ///< with its trace
  BoundedPlan plan;              ///< with profiles
};

/// The parameter updates, as the machine file calls them.
inline constexpr std::array<const char*, 4> kUpdates{"taylor1", "taylor2", "rk4", "corrected"};

/// Feedrate fluctuation of the set points under one parameter update.
struct Fluctuation {
  std::string program;           ///< file name
  std::string feedrate_rule;     ///< "constant", or that of the machine file
  std::string parameter_update;  ///< "taylor1", "taylor2", "rk4", "corrected"
  results::ShareStats shares;
  std::filesystem::path folder;  ///< with the trace of the plan
};

struct Comparison {
  std::string program;  ///< file name
  std::string machine;
  std::string hal;
  Limits limits;
  double period = 0.0;  ///< [s]
  std::vector<Contestant> contestants;
  std::vector<Fluctuation> fluctuations;  ///< by program, rule, update; of programs with curves
};

/// Runs a program under each interpolator of the paper's planner and under the certified one, side
/// by side, and plans it under each parameter update with the feedrate rule of the machine file and
/// at constant feedrate.
///
/// Planning is timed by itself, one after the other, the best of three, and once more with the
/// lower bound of its time.
Expected<Comparison> compare(const Request& request);

/// A job of a request: its machine file with its settings and further ones.
Expected<studies::jobs::Job> job_of(const Request& request, const gcode::ProgramText& program,
                                    const std::string& name,
                                    const std::vector<std::string>& settings);

/// Wall-clock time of planning a job's program alone, from reading it to the last planned segment
/// [s]. It is the best of three, because other programs use the cores too.
Expected<double> planning_time(const studies::jobs::Job& job);

}  // namespace twin::studies::compare
