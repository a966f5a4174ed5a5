#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/run_jobs.hpp"
#include "compare/comparison.hpp"

namespace twin::compare {

/// A job of a request: its machine file with its settings and further ones.
Expected<batch::Job> job_of(const Request& request, const std::filesystem::path& program,
                            const std::string& name, const std::vector<std::string>& settings);

/// Wall-clock time of planning a job's program alone [s]; the best of three, for others use the
/// cores too.
Expected<double> planning_time(const batch::Job& job);

}  // namespace twin::compare
