#include "studies/compare/planning_jobs.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::studies::compare {

Expected<studies::Job> job_of(const Request& request, const std::filesystem::path& program,
                              const std::string& name, const std::vector<std::string>& settings) {
  std::vector<std::string> all = request.settings;
  all.insert(all.end(), settings.begin(), settings.end());
  TWIN_TRY(config::MachineFile machine, config::read_machine_file(request.machine_file, all));
  return studies::Job{.name = name,
                      .program = program,
                      .machine = std::move(machine),
                      .feedrate = request.feedrate,
                      .directory = {}};
}

Expected<double> planning_time(const studies::Job& job) {
  gcode::ReaderOptions options;
  options.feedrate = job.feedrate;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    TWIN_TRY(gcode::Reader reader, gcode::Reader::open(job.program.string(), options));
    TWIN_CHECK(runtime::plan_program(reader, job.machine,
                                     [](feedrate::PlannedSegment&&) { return true; }));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

}  // namespace twin::studies::compare
