#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "studies/batch/job.hpp"

namespace twin::studies::batch {

/// Most jobs of a job file or of a sweep. Beyond this it is taken for a mistake.
inline constexpr std::size_t kMostJobs = 1'000'000;

/// Reads a job file: JSON lines, one job each, blank lines left out.
///
///     {"program": "dolphin.nc", "machine": "xy_table.toml",
///      "set": {"servo.x.kp_per_s": 200}, "feedrate_mm_per_min": 3000, "hal": "mujoco",
///      "overrides": [[0, 100], [2, 50]], "trace": true}   trace: true, false or as --trace takes it
///
/// All keys but `program` may be missing. @returns the jobs, or the first error with file, line and
/// column: what was found and what was expected.
Expected<std::vector<Job>> read_jobs(const std::filesystem::path& file);

/// The job of one line. @param file  for messages @param line  its number, from 1
Expected<Job> parse_job(std::string_view text, const std::filesystem::path& file, int line);

/// The line of a job, as read_jobs() reads it, without a line feed.
std::string to_line(const Job& job);

}  // namespace twin::studies::batch
