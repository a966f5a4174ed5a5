#pragma once

#include <atomic>
#include <memory>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "motion/correction/correction_follower.hpp"
#include "runtime/run.hpp"
#include "session/session.hpp"
#include "twin/trace.hpp"

namespace twin::cli {

/// The correction of a run by --compensate and --learn: found before the run, made better after it.
class CorrectedRun {
 public:
  /// Reads or makes the correction and puts it into the request of the run. Nothing moves before a
  /// correction that does not fit has been refused.
  static Expected<CorrectedRun> prepare(const CorrectionArguments& arguments,
                                        session::Request& request, Verbosity verbosity,
                                        const std::atomic<bool>& stop);

  /// With --learn: makes a better correction of what the run has measured, unless the run ended
  /// early or left the plan of its correction.
  Expected<void> learn_from(const runtime::RunResult& result, const std::atomic<bool>& stop);

 private:
  CorrectionArguments arguments_;
  gcode::ProgramText program_;
  config::MachineFile machine_;
  std::optional<double> feedrate_;
  Verbosity verbosity_ = Verbosity::kNormal;
  std::shared_ptr<const motion::Correction> correction_;
  std::unique_ptr<MemoryTrace> trace_;
};

/// `twin run` with its correction, what it learns and its prediction, of which each may be absent.
Expected<void> run_with_studies(const RunArguments& arguments, const Environment& environment);

}  // namespace twin::cli
