#include "studies/batch/job_file.hpp"
#include "studies/batch/sweep_file.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/temporary_folder.hpp"

namespace twin::fuzz {
namespace jobs_target {

using namespace studies;

/// A job that was read means the same when it is written and read again.
void read_as_jobs(Bytes bytes) {
  const MemoryFile file(bytes);
  const auto jobs = batch::read_jobs(file.path());
  if (!jobs) {
    promise(!jobs.error().message.empty(), "an error of jobs without a message");
    return;
  }
  for (const batch::Job& job : *jobs) {
    promise(!job.program.empty(), "a job without a program");
    const std::string line = batch::to_line(job);
    const auto again = batch::parse_job(line, "again", 1);
    promise(again.has_value(), "a job that is written cannot be read: " + line);
    promise(batch::to_line(*again) == line, "a job that is written is another one: " + line);
  }
}

void read_as_sweep(Bytes bytes) {
  const auto sweep = batch::parse_sweep(text_of(bytes), "/nowhere/sweep.toml");
  promise(sweep || !sweep.error().message.empty(), "an error of a sweep without a message");
}

/// The bytes as what twin identify has found.
void read_as_identified(Bytes bytes) {
  static const TemporaryFolder folder;
  folder.write("identify.json", text_of(bytes));
  const auto sweep = batch::parse_sweep(
      "program = \"a.nc\"\n[monte_carlo]\ncount = 2\nseed = 1\nidentified = \"identify.json\"\n",
      folder.path() / "sweep.toml");
  promise(sweep || !sweep.error().message.empty(), "an error of identify.json without a message");
}

void run(Bytes bytes) {
  read_as_jobs(bytes);
  read_as_sweep(bytes);
  read_as_identified(bytes);
}

}  // namespace jobs_target

const Target kJobs{"jobs", jobs_target::run};

}  // namespace twin::fuzz
