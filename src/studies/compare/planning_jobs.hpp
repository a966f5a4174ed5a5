#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/compare/comparison.hpp"
#include "studies/jobs/run_jobs.hpp"

namespace twin::studies::compare {

/// A job of a request: its machine file with its settings and further ones.
Expected<studies::Job> job_of(const Request& request, const std::filesystem::path& program,
                              const std::string& name, const std::vector<std::string>& settings);

/// Wall-clock time of planning a job's program alone, from reading it to the last planned segment
/// [s]. It is the best of three, because other programs use the cores too.
Expected<double> planning_time(const studies::Job& job);

}  // namespace twin::studies::compare
