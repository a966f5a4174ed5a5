#include "studies/jobs/run_jobs.hpp"

#include <limits>
#include <mutex>
#include <system_error>
#include <utility>

#include "core/parallel_for.hpp"
#include "runtime/run.hpp"

namespace twin::studies::jobs {
namespace {

Error named(const Job& job, Error error) {
  error.message = job.name + ": " + error.message;
  return error;
}

Expected<results::Summary> run_job(const Job& job, const Options& options) {
  const auto hal = job.has_machine ? options.make_machine(job.machine) : nullptr;
  runtime::RunRequest request;
  request.program = job.program;
  request.machine = job.machine;
  request.hal = hal.get();
  request.feedrate = job.feedrate;
  request.directory = job.directory;
  request.durability = Durability::kCached;  // studies read the trace at once and write their own
  request.stop = options.stop;
  request.trace = options.trace;
  auto result = runtime::run_program(request);
  if (!job.keeps_results) {
    std::error_code ignored;
    std::filesystem::remove_all(job.directory, ignored);
  }
  if (!result) {
    return tl::unexpected(named(job, std::move(result.error())));
  }
  if (result->failure) {
    return tl::unexpected(named(job, std::move(*result->failure)));
  }
  return std::move(result->summary);
}

/// The same in a thread, which nothing may escape.
Expected<results::Summary> run_guarded(const Job& job, const Options& options) {
  try {
    return run_job(job, options);
  } catch (const std::exception& error) {
    return tl::unexpected(named(job, Error{ErrorCode::kMachine, error.what(), {}, 0, 0}));
  }
}

/// The jobs and how far they are, shared by the workers.
class Progress {
 public:
  Progress(std::span<const Job> jobs, const Options& options)
      : jobs_(jobs), options_(options), summaries_(jobs.size()) {}

  /// Runs a job, unless it is not wanted any more. Several threads call it.
  void run(std::size_t i) {
    if (!is_wanted(i)) {
      return;
    }
    auto summary = run_guarded(jobs_[i], options_);
    const std::lock_guard lock(mutex_);
    if (summary) {
      summaries_[i] = std::move(*summary);
    } else if (i < first_failed_) {
      error_ = std::move(summary.error());
      first_failed_ = i;
    }
    ++done_;
    if (options_.progress) {
      options_.progress(static_cast<double>(done_) / static_cast<double>(jobs_.size()));
    }
  }

  Expected<std::vector<results::Summary>> finish() {
    if (error_) {
      return tl::unexpected(std::move(*error_));
    }
    if (done_ < jobs_.size()) {
      return fail(ErrorCode::kInterrupted, "interrupted");
    }
    return std::move(summaries_);
  }

 private:
  /// A job before the first that failed is run even after that failure: it may be the first to
  /// fail.
  bool is_wanted(std::size_t job) const {
    return job < first_failed_ && !(options_.stop != nullptr && options_.stop->load());
  }

  std::span<const Job> jobs_;
  const Options& options_;
  std::atomic<std::size_t> first_failed_{std::numeric_limits<std::size_t>::max()};
  std::mutex mutex_;  // of what follows
  std::vector<results::Summary> summaries_;
  std::optional<Error> error_;
  std::size_t done_ = 0;
};

}  // namespace

Expected<std::vector<results::Summary>> run_jobs(std::span<const Job> jobs,
                                                 const Options& options) {
  Progress progress(jobs, options);
  parallel_for(jobs.size(), [&progress](std::size_t i) { progress.run(i); });
  return progress.finish();
}

}  // namespace twin::studies::jobs
