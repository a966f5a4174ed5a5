#include "studies/compare/comparison.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "studies/compare/jobs.hpp"

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
Expected<void> add_plan_figures(const studies::Job& job, Contestant& contestant) {
  const auto time = planning_time(job);
  if (!time) {
    return tl::unexpected(time.error());
  }
  auto plan = bounded_plan(job.program, job.machine, job.feedrate, true);
  if (!plan) {
    return tl::unexpected(std::move(plan.error()));
  }
  contestant.planning_time = *time;
  contestant.plan = std::move(*plan);
  return {};
}

Expected<void> run_contestants(const Request& request, Comparison& result) {
  std::vector<studies::Job> jobs;
  for (const Entry& entry : kEntries) {
    auto job = job_of(request, request.program, entry.name(), entry.settings());
    if (!job) {
      return tl::unexpected(std::move(job.error()));
    }
    job->directory = request.folder / ("run_" + entry.name());
    jobs.push_back(std::move(*job));
  }
  auto summaries = studies::run_jobs(jobs, request.running);
  if (!summaries) {
    return tl::unexpected(std::move(summaries.error()));
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Contestant contestant{
        jobs[i].name, kEntries[i].planner, (*summaries)[i], jobs[i].directory, 0.0, {}};
    if (auto added = add_plan_figures(jobs[i], contestant); !added) {
      return added;
    }
    result.contestants.push_back(std::move(contestant));
  }
  result.machine = jobs.front().machine.name;
  result.hal = summaries->front().hal;
  result.limits = jobs.front().machine.limits;
  result.period = jobs.front().machine.period;
  return {};
}

/// Adds the plans of one program, each update under each rule.
Expected<void> add_plans(const Request& request, const std::filesystem::path& program,
                         std::vector<studies::Job>& jobs, std::vector<Fluctuation>& fluctuations) {
  for (const std::string rule : {"", "constant"}) {
    for (const std::string update : kUpdates) {
      std::vector<std::string> settings{"planning.planner=paper", "path.curves=nurbs",
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
  std::vector<studies::Job> jobs;
  std::vector<std::filesystem::path> programs = request.curve_programs;
  if (result.contestants.front().summary.segments.curves > 0) {
    programs.insert(programs.begin(), request.program);
  }
  for (const auto& program : programs) {
    if (auto added = add_plans(request, program, jobs, result.fluctuations); !added) {
      return added;
    }
  }
  auto summaries = studies::run_jobs(jobs, request.running);
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

}  // namespace twin::studies::compare
