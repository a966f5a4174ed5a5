#pragma once

#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "results/metrics/limit_audit.hpp"
#include "results/metrics/summary.hpp"
#include "results/trace/sample.hpp"
#include "runtime/motion.hpp"
#include "runtime/override_schedule.hpp"

namespace twin::test {

/// What became of a program that was followed in lockstep under a schedule of overrides.
struct OverrideRun {
  std::vector<results::Sample> samples;
  std::vector<results::OverrideRecord> records;
  runtime::MotionEnd end = runtime::MotionEnd::kDone;
};

/// Plans a program's text and follows it, without a machine.
OverrideRun run_with_overrides(const std::string& text, const config::MachineFile& machine,
                               const std::vector<runtime::OverrideChange>& schedule);

/// What a run with overrides is held against: the same program without.
struct PlainRun {
  OverrideRun run;
  results::AuditPeaks peaks;  ///< largest over the phases that set points can have to the path
  std::vector<Vec3> path;     ///< its path, a few micrometres from point to point [mm]
};
PlainRun run_plain(const std::string& text, const config::MachineFile& machine);

/// Fails unless the set points keep the limits as well as the plain ones do, end where those end,
/// and lie on their path in its order.
void expect_same_path_within_limits(const OverrideRun& run, const PlainRun& plain,
                                    const config::MachineFile& machine);

}  // namespace twin::test
