#include "studies/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <utility>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"
#include "runtime/run_options.hpp"

namespace twin::studies::compare {
namespace {

/// Who runs: the interpolators under the paper's planner, and the certified one.
struct Entry {
  const char* planner;
  const char* interpolator;

  bool is_paper() const { return std::string_view(planner) == "paper"; }
  std::string name() const { return is_paper() ? interpolator : planner; }
  std::vector<std::string> settings() const {
    return {fmt::format("planning.planner={}", planner),
            fmt::format("path.curves={}", interpolator)};
  }
};

constexpr std::array<Entry, 4> kEntries{
    {{"paper", "nurbs"}, {"paper", "bezier"}, {"paper", "linear"}, {"certified", "nurbs"}}};

/// Plans a job by itself, with its bound.
Expected<void> add_plan(const studies::jobs::Job& job, Contestant& contestant) {
  TWIN_TRY(contestant.summary.planning_time, planning_time(job));
  TWIN_TRY(contestant.plan,
           bounded_plan(job.program, job.machine, job.feedrate, Profiles::kRecorded));
  contestant.summary.time_bound = contestant.plan.time_bound_with_jerk;
  return {};
}

Expected<void> run_contestants(const Request& request, Comparison& result) {
  std::vector<studies::jobs::Job> jobs;
  for (const Entry& entry : kEntries) {
    TWIN_TRY(studies::jobs::Job job,
             job_of(request, request.program, entry.name(), entry.settings()));
    job.directory = request.folder / ("run_" + entry.name());
    jobs.push_back(std::move(job));
  }
  TWIN_TRY(const std::vector<results::Summary> summaries,
           studies::jobs::run_jobs(jobs, request.running));
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Contestant contestant{.name = jobs[i].name,
                          .planner = kEntries[i].planner,
                          .summary = summaries[i],
                          .folder = jobs[i].directory,
                          .plan = {}};
    TWIN_CHECK(add_plan(jobs[i], contestant));
    result.contestants.push_back(std::move(contestant));
  }
  result.machine = jobs.front().machine.name;
  result.hal = summaries.front().hal;
  result.limits = jobs.front().machine.limits;
  result.period = jobs.front().machine.period;
  return {};
}

/// Adds the plans of one program, each update under each rule.
Expected<void> add_plans(const Request& request, const gcode::ProgramText& program,
                         std::vector<studies::jobs::Job>& jobs,
                         std::vector<Fluctuation>& fluctuations) {
  for (const std::string rule : {"", "constant"}) {
    for (const std::string update : kUpdates) {
      std::vector<std::string> settings{"planning.planner=paper", "path.curves=nurbs",
                                        "interpolator.parameter_update=" + update};
      if (!rule.empty()) {
        settings.push_back("planning.feedrate_rule=" + rule);
      }
      const std::string file = program.file().filename().string();
      TWIN_TRY(studies::jobs::Job job, job_of(request, program, file + ", " + update, settings));
      job.has_machine = false;
      job.directory = request.folder / fmt::format("plan_{}", jobs.size());
      fluctuations.push_back({.program = file,
                              .feedrate_rule = rule.empty() ? "default" : rule,
                              .parameter_update = update,
                              .shares = {},
                              .folder = job.directory});
      jobs.push_back(std::move(job));
    }
  }
  return {};
}

Expected<void> plan_updates(const Request& request, Comparison& result) {
  std::vector<studies::jobs::Job> jobs;
  std::vector<gcode::ProgramText> programs = request.curve_programs;
  if (result.contestants.front().summary.segments.curves > 0) {
    programs.insert(programs.begin(), request.program);
  }
  for (const auto& program : programs) {
    TWIN_CHECK(add_plans(request, program, jobs, result.fluctuations));
  }
  TWIN_TRY(const std::vector<results::Summary> summaries,
           studies::jobs::run_jobs(jobs, request.running));
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    result.fluctuations[i].shares = summaries[i].feedrate_fluctuation;
  }
  return {};
}

}  // namespace

Expected<Comparison> compare(const Request& request) {
  Comparison result;
  result.program = request.program.file().filename().string();
  TWIN_CHECK(run_contestants(request, result));
  TWIN_CHECK(plan_updates(request, result));
  return result;
}

Expected<studies::jobs::Job> job_of(const Request& request, const gcode::ProgramText& program,
                                    const std::string& name,
                                    const std::vector<std::string>& settings) {
  std::vector<std::string> all = request.settings;
  all.insert(all.end(), settings.begin(), settings.end());
  TWIN_TRY(config::MachineFile machine, config::read_machine_file(request.machine_file, all));
  return studies::jobs::Job{.name = name,
                            .program = program,
                            .machine = std::move(machine),
                            .feedrate = request.feedrate,
                            .directory = {}};
}

Expected<double> planning_time(const studies::jobs::Job& job) {
  const gcode::ReaderOptions options = runtime::reader_options(job.machine, job.feedrate);
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    gcode::Reader reader(job.program, options);
    TWIN_CHECK(runtime::plan_program(reader, job.machine,
                                     [](feedrate::PlannedSegment&&) { return true; }));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

}  // namespace twin::studies::compare
