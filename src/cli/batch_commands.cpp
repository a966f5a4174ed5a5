#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/study_commands.hpp"
#include "cli/terminal.hpp"
#include "core/parallel_for.hpp"
#include "core/wall_clock.hpp"
#include "session/results.hpp"
#include "studies/batch/batch.hpp"
#include "studies/batch/job_file.hpp"
#include "studies/batch/sweep_file.hpp"
#include "studies/batch/sweep_results.hpp"

// The commands of many runs: twin batch and twin sweep.
namespace twin::cli {
namespace {

namespace batch = studies::batch;

/// Parts of the jobs that are prepared side by side, each with its own copy of their programs.
constexpr std::size_t kParts = 16;

/// Prepares jobs. An error names the job by its number, which in a job file is its line.
Expected<std::vector<batch::PreparedJob>> prepare(const std::vector<batch::Job>& jobs) {
  const std::size_t parts = std::min<std::size_t>(jobs.size(), kParts);
  std::vector<batch::PreparedJob> prepared(jobs.size());
  std::vector<std::optional<Error>> errors(parts);
  parallel_for(parts, [&](std::size_t part) {
    batch::JobMaker maker;
    const std::size_t end = (part + 1) * jobs.size() / parts;
    for (std::size_t i = part * jobs.size() / parts; i < end; ++i) {
      auto job = maker.prepare(jobs[i]);
      if (!job) {
        errors[part] = std::move(job.error());
        errors[part]->message = fmt::format("job {}: {}", i + 1, errors[part]->message);
        return;
      }
      prepared[i] = std::move(*job);
    }
  });
  for (auto& error : errors) {
    if (error) {
      return tl::unexpected(*std::move(error));
    }
  }
  return prepared;
}

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 60 ? fmt::format("{} s", whole)
                    : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

using TakeResult = std::function<void(const batch::PreparedJob&, const batch::StoredResult&)>;

Expected<batch::Report> run(const std::vector<batch::PreparedJob>& jobs, const batch::Store& store,
                            const BatchRunArguments& arguments, const Environment& environment,
                            TakeResult take_result = {}) {
  Progress progress("running", arguments.verbosity);
  batch::Options options;
  options.workers = arguments.workers;
  options.shard = arguments.shard;
  options.shards = arguments.shards;
  options.stop = &environment.stop;
  options.result = std::move(take_result);
  options.progress = [&](const batch::Progress& at) {
    progress.rename(
        fmt::format("{} of {} runs, {} left", at.done, at.jobs, time_text(at.time_left)));
    progress.show(static_cast<double>(at.done) / static_cast<double>(at.jobs));
  };
  return batch::run_batch(jobs, store, options);
}

void print(const batch::Report& report, const batch::Store& store, Verbosity verbosity) {
  if (verbosity == Verbosity::kNormal) {
    print_out(
        "{} jobs: {} computed in {}, {} were in the store, {} failed\n{}store: {}\n", report.jobs,
        report.computed, time_text(report.time), report.found, report.failed,
        report.redone == 0
            ? ""
            : fmt::format("broken in the store, or of other subprograms, and computed again: {}\n",
                          report.redone),
        store.folder().string());
  }
}

}  // namespace

Expected<void> execute(const BatchArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto jobs, batch::read_jobs(arguments.jobs));
  TWIN_TRY(const auto prepared, prepare(jobs));
  TWIN_TRY(const auto store, batch::Store::open(arguments.run.store));
  TWIN_TRY(const auto report, run(prepared, store, arguments.run, environment));
  print(report, store, arguments.run.verbosity);
  return {};
}

Expected<void> execute(const SweepArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto sweep, batch::read_sweep(arguments.sweep));
  TWIN_TRY(const auto points, batch::points_of(sweep));
  std::vector<batch::Job> jobs;
  for (const batch::SweepPoint& point : points) {
    jobs.push_back(point.job);
  }
  if (arguments.is_listed_only) {
    for (const batch::Job& job : jobs) {
      print_out("{}\n", batch::to_line(job));
    }
    return {};
  }
  TWIN_TRY(const auto prepared, prepare(jobs));
  const std::filesystem::path out =
      session::result_folder(arguments.folder, arguments.sweep.stem().string());
  BatchRunArguments conduct = arguments.run;
  conduct.store = conduct.store.empty() ? out / "store" : conduct.store;
  TWIN_TRY(const auto store, batch::Store::open(conduct.store));
  std::map<std::string, batch::StoredResult, std::less<>> results;
  TWIN_TRY(const auto report,
           run(prepared, store, conduct, environment,
               [&results](const batch::PreparedJob& job, const batch::StoredResult& result) {
                 results.emplace(job.key, batch::figures_of(result));
               }));
  print(report, store, conduct.verbosity);
  std::vector<batch::Row> rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows.push_back({points[i], prepared[i], results.at(prepared[i].key)});
  }
  TWIN_CHECK(
      batch::write_sweep(batch::keys_of(sweep), rows, arguments.sweep.filename().string(), out));
  if (conduct.verbosity == Verbosity::kNormal) {
    print_out("table, page and best settings: {}\n", (out / "index.html").string());
  }
  return {};
}

}  // namespace twin::cli
