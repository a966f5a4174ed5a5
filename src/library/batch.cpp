#include "twin/batch.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "library/inside.hpp"
#include "studies/batch/batch.hpp"
#include "studies/batch/job_file.hpp"
#include "studies/batch/sweep_file.hpp"
#include "studies/batch/sweep_results.hpp"

namespace twin {
namespace {

namespace inner = studies::batch;

inner::PreparedJob prepared(const std::string& job) {
  return value_of(inner::JobMaker().prepare(value_of(inner::parse_job(job, "job", 1))));
}

}  // namespace

std::vector<std::string> sweep_jobs(const std::string& sweep_file) {
  std::vector<std::string> lines;
  for (const auto& point : value_of(inner::points_of(value_of(inner::read_sweep(sweep_file))))) {
    lines.push_back(inner::to_line(point.job));
  }
  return lines;
}

std::string job_key(const std::string& job) { return prepared(job).key; }

JobResult run_job(const std::string& job, const std::string& store, const std::atomic<bool>* stop) {
  const inner::PreparedJob made = prepared(job);
  const inner::Store results = value_of(inner::Store::open(store));
  inner::Options options;
  options.workers = 1;
  options.stop = stop;
  const inner::Report report = value_of(inner::run_batch(std::span(&made, 1), results, options));
  const auto found = results.find(made);
  if (!found) {
    throw Failure({ErrorCode::kFile, "has lost a result while it was read", store, 0, 0});
  }
  return {made.key, report.found > 0, found->summary, found->failure};
}

void write_sweep(const std::string& sweep_file, const std::string& store,
                 const std::string& folder) {
  const inner::Sweep sweep = value_of(inner::read_sweep(sweep_file));
  const inner::Store results = value_of(inner::Store::open(store));
  inner::JobMaker maker;
  std::vector<inner::Row> rows;
  for (const inner::SweepPoint& point : value_of(inner::points_of(sweep))) {
    const inner::PreparedJob job = value_of(maker.prepare(point.job));
    const auto result = results.find(job);
    if (!result) {
      throw Failure(
          {ErrorCode::kFile, fmt::format("has no result of job {}", rows.size() + 1), store, 0, 0});
    }
    rows.push_back({point, job, *result});
  }
  check(inner::write_sweep(inner::keys_of(sweep), rows,
                           std::filesystem::path(sweep_file).filename().string(), folder));
}

}  // namespace twin
