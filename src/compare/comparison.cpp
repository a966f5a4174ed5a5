#include "compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <utility>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::compare {
namespace {

Expected<batch::Job> job_of(const Request& request, const std::filesystem::path& program,
                            const std::string& name, const std::vector<std::string>& settings) {
  std::vector<std::string> all = request.settings;
  all.insert(all.end(), settings.begin(), settings.end());
  auto machine = config::read_machine_file(request.machine_file, all);
  if (!machine) {
    return tl::unexpected(std::move(machine.error()));
  }
  return batch::Job{name, program, std::move(*machine), request.feedrate, {}};
}

/// Wall-clock time of planning a job's program; the best of three, for others use the cores too.
Expected<double> planning_time(const batch::Job& job) {
  gcode::ReaderOptions options;
  options.feedrate = job.feedrate;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    auto planned =
        gcode::Reader::open(job.program.string(), options).and_then([&](gcode::Reader&& reader) {
          return runtime::plan_program(reader, job.machine,
                                       [](feedrate::PlannedSegment&&) { return true; });
        });
    if (!planned) {
      return tl::unexpected(std::move(planned.error()));
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

/// Runs the interpolators.
Expected<void> run_contestants(const Request& request, Comparison& result) {
  std::vector<batch::Job> jobs;
  for (const std::string_view name : kInterpolatorNames) {
    auto job = job_of(request, request.program, std::string(name),
                      {"interpolator.kind=" + std::string(name)});
    if (!job) {
      return tl::unexpected(std::move(job.error()));
    }
    job->directory = request.folder / ("run_" + std::string(name));
    jobs.push_back(std::move(*job));
  }
  auto summaries = batch::run_jobs(jobs, request.running);
  if (!summaries) {
    return tl::unexpected(std::move(summaries.error()));
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto time = planning_time(jobs[i]);
    if (!time) {
      return tl::unexpected(time.error());
    }
    result.contestants.push_back({jobs[i].name, (*summaries)[i], jobs[i].directory, *time});
  }
  result.machine = jobs.front().machine.name;
  result.hal = summaries->front().hal;
  result.limits = jobs.front().machine.limits;
  result.period = jobs.front().machine.period;
  return {};
}

/// Adds the plans of one program, each update under each rule.
Expected<void> add_plans(const Request& request, const std::filesystem::path& program,
                         std::vector<batch::Job>& jobs, std::vector<Fluctuation>& fluctuations) {
  for (const std::string rule : {"", "constant"}) {
    for (const std::string update : kUpdates) {
      std::vector<std::string> settings{"interpolator.kind=nurbs",
                                        "interpolator.parameter_update=" + update};
      if (!rule.empty()) {
        settings.push_back("planning.feedrate_rule=" + rule);
      }
      auto job = job_of(request, program, program.filename().string() + ", " + update, settings);
      if (!job) {
        return tl::unexpected(std::move(job.error()));
      }
      job->has_machine = false;
      job->directory = request.folder / fmt::format("plan_{}", jobs.size());
      fluctuations.push_back({program.filename().string(),
                              rule.empty() ? "default" : rule,
                              update,
                              {},
                              job->directory});
      jobs.push_back(std::move(*job));
    }
  }
  return {};
}

Expected<void> plan_updates(const Request& request, Comparison& result) {
  std::vector<batch::Job> jobs;
  std::vector<std::filesystem::path> programs = request.curve_programs;
  if (result.contestants.front().summary.segments.curves > 0) {
    programs.insert(programs.begin(), request.program);
  }
  for (const auto& program : programs) {
    if (auto added = add_plans(request, program, jobs, result.fluctuations); !added) {
      return added;
    }
  }
  auto summaries = batch::run_jobs(jobs, request.running);
  if (!summaries) {
    return tl::unexpected(std::move(summaries.error()));
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    result.fluctuations[i].shares = (*summaries)[i].feedrate_fluctuation;
  }
  return {};
}

}  // namespace

Expected<Comparison> compare(const Request& request) {
  Comparison result;
  result.program = request.program.filename().string();
  if (auto run = run_contestants(request, result); !run) {
    return tl::unexpected(std::move(run.error()));
  }
  if (auto planned = plan_updates(request, result); !planned) {
    return tl::unexpected(std::move(planned.error()));
  }
  return result;
}

}  // namespace twin::compare
