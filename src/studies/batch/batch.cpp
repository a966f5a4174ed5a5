#include "studies/batch/batch.hpp"

#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>

#include "core/parallel_for.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/run.hpp"
#include "runtime/run_errors.hpp"
#include "session/machine.hpp"

namespace twin::studies::batch {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Whether an error tells of the computer, which may do better another time, and not of the job.
bool is_of_host(const Error& error) {
  return error.code == ErrorCode::kFile || error.code == ErrorCode::kHost;
}

/// The jobs of a batch and how far they are, shared by the threads.
class Work {
 public:
  Work(std::span<const PreparedJob* const> jobs, const Store& store, const Options& options)
      : jobs_(jobs), store_(store), options_(options) {
    report_.jobs = jobs_.size();
  }

  /// Does a job, unless the batch has ended. Several threads call it.
  void run(std::size_t i) {
    if (is_over()) {
      return;
    }
    const Expected<Outcome> outcome = do_job(*jobs_[i]);
    const std::lock_guard lock(mutex_);
    note(*jobs_[i], outcome);
  }

  Expected<Report> finish() {
    report_.time = seconds_since(start_);
    if (error_) {
      return tl::unexpected(std::move(*error_));
    }
    if (is_stopped()) {
      return fail(ErrorCode::kInterrupted, "interrupted: what is stored stays");
    }
    if (host_error_) {
      host_error_->message += fmt::format(
          "; {} of {} jobs are not kept for such reasons, and run again at the next call", left_,
          report_.jobs);
      return tl::unexpected(std::move(*host_error_));
    }
    return report_;
  }

 private:
  struct Outcome {
    bool was_found = false;
    bool was_broken = false;
    StoredResult result;
    std::optional<Error> host_error;  // why there is no result, though the store is well
  };

  bool is_stopped() const { return options_.stop != nullptr && options_.stop->load(); }
  bool is_over() const { return is_stopped() || is_broken_; }

  Expected<Outcome> do_job(const PreparedJob& job) const {
    const bool has_entry = store_.has_entry(job);
    if (const auto stored = store_.find(job)) {
      return Outcome{true, false, *stored, {}};
    }
    TWIN_TRY(const std::filesystem::path folder, store_.begin(job));
    Expected<StoredResult> result = guarded(job, folder);
    if (!result && is_of_host(result.error())) {
      remove(folder);
      return Outcome{false, false, {}, std::move(result).error()};
    }
    const auto kept = result.and_then([&](const StoredResult& computed) {
      return store_.commit(job, folder, computed).map([&] {
        return Outcome{false, has_entry, computed, {}};
      });
    });
    if (!kept) {
      remove(folder);
    }
    return kept;
  }

  static void remove(const std::filesystem::path& folder) {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  Expected<StoredResult> guarded(const PreparedJob& job,
                                 const std::filesystem::path& folder) const {
    try {
      return run_job(job, folder, options_.stop);
    } catch (...) {
      return tl::unexpected(runtime::thrown("the run"));
    }
  }

  void note(const PreparedJob& job, const Expected<Outcome>& outcome) {
    if (!outcome) {
      if (outcome.error().code != ErrorCode::kInterrupted && !error_) {
        error_ = outcome.error();
        is_broken_ = true;
      }
      return;
    }
    if (outcome->host_error) {
      ++left_;
      host_error_ = host_error_ ? host_error_ : outcome->host_error;
      return;
    }
    ++(outcome->was_found ? report_.found : report_.computed);
    report_.redone += outcome->was_broken ? 1 : 0;
    report_.failed += outcome->result.failure.empty() ? 0 : 1;
    if (options_.result) {
      options_.result(job, outcome->result);
    }
    if (options_.progress) {
      const std::size_t done = report_.found + report_.computed;
      const double pace = report_.computed == 0
                              ? 0.0
                              : seconds_since(start_) / static_cast<double>(report_.computed);
      options_.progress({jobs_.size(), done, pace * static_cast<double>(jobs_.size() - done)});
    }
  }

  std::span<const PreparedJob* const> jobs_;
  const Store& store_;
  const Options& options_;
  Clock::time_point start_ = Clock::now();
  std::atomic<bool> is_broken_{false};
  std::mutex mutex_;  // of what follows
  Report report_;
  std::optional<Error> error_;
  std::size_t left_ = 0;             // jobs without a result
  std::optional<Error> host_error_;  // of the first of them
};

/// The jobs of the shard, of equal ones the first.
std::vector<const PreparedJob*> chosen(std::span<const PreparedJob> jobs, const Options& options) {
  std::vector<const PreparedJob*> result;
  std::set<std::string_view> keys;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (i % options.shards == options.shard && keys.insert(jobs[i].key).second) {
      result.push_back(&jobs[i]);
    }
  }
  return result;
}

}  // namespace

Expected<StoredResult> run_job(const PreparedJob& job, const std::filesystem::path& folder,
                               const std::atomic<bool>* stop) {
  std::unique_ptr<hal::Machine> hal;
  if (job.job.hal != JobMachine::kNone) {
    TWIN_TRY(hal, session::make_simulated_machine(name_of(job.job.hal), job.machine));
  }
  runtime::RunRequest request;
  request.program = job.program;
  request.machine = job.machine;
  request.hal = hal.get();
  request.feedrate = job.job.feedrate;
  request.overrides = job.job.overrides;
  request.directory =
      job.job.trace == results::TraceFiles::kNone ? std::filesystem::path() : folder;
  request.trace = job.job.trace;
  request.durability = Durability::kCached;
  request.stop = stop;
  const auto result = runtime::run_program(request);
  const Error* const error = !result           ? &result.error()
                             : result->failure ? &*result->failure
                                               : nullptr;
  if (error == nullptr) {
    return StoredResult{results::to_reproducible_json(result->summary), {}};
  }
  if (error->code == ErrorCode::kInterrupted || is_of_host(*error)) {
    return tl::unexpected(*error);
  }
  std::error_code ignored;
  std::filesystem::remove(folder / results::kPartialTraceName, ignored);
  std::filesystem::remove(folder / results::kPartialHdf5TraceName, ignored);
  return StoredResult{{}, to_string(*error)};
}

Expected<Report> run_batch(std::span<const PreparedJob> jobs, const Store& store,
                           const Options& options) {
  const std::vector<const PreparedJob*> wanted = chosen(jobs, options);
  Work work(wanted, store, options);
  parallel_for(
      wanted.size(), [&work](std::size_t i) { work.run(i); }, options.workers);
  return work.finish();
}

}  // namespace twin::studies::batch
