#include "cli/corrected_run.hpp"

#include <fmt/format.h>

#include <atomic>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/machines.hpp"
#include "cli/predictions.hpp"
#include "cli/run_command.hpp"
#include "cli/study_commands.hpp"
#include "cli/terminal.hpp"
#include "motion/correction/correction_follower.hpp"
#include "runtime/correction_file.hpp"
#include "session/results.hpp"
#include "studies/compensate/learning.hpp"
#include "twin/trace.hpp"

// Corrections of set points: twin compensate, run --compensate, run --learn.
namespace twin::cli {
namespace {

using studies::compensate::LearningFolder;
using studies::compensate::MadeCorrection;

/// Makes a correction with a progress bar.
Expected<MadeCorrection> make_shown(const gcode::ProgramText& program,
                                    const config::MachineFile& machine,
                                    const std::optional<double>& feedrate,
                                    std::vector<Vec2> mismatch, Verbosity verbosity,
                                    const std::atomic<bool>& stop) {
  Progress progress("correcting", verbosity);
  studies::compensate::CompensateOptions options;
  options.mismatch = std::move(mismatch);
  options.stop = &stop;
  options.progress = progress.callback();
  return studies::compensate::make_correction(program, machine, feedrate, options);
}

Expected<void> check_learning(const CorrectionArguments& arguments,
                              const session::Request& request) {
  if (arguments.learning.empty()) {
    return {};
  }
  if (!arguments.file.empty()) {
    return fail(ErrorCode::kUsage,
                "--learn DIR has its own correction: leave out the FILE of --compensate");
  }
  if (!request.overrides.empty()) {
    return fail(ErrorCode::kUsage,
                "--learn wants a run at its programmed feedrate: leave out --override");
  }
  if (!request.columns.empty()) {
    return fail(ErrorCode::kUsage, "--learn needs the default columns: leave out --columns");
  }
  std::error_code code;
  std::filesystem::create_directories(arguments.learning, code);
  if (code) {
    return file_error(arguments.learning, "make this folder", code.value());
  }
  return {};
}

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

Expected<CorrectedRun> CorrectedRun::prepare(const CorrectionArguments& arguments,
                                             session::Request& request, Verbosity verbosity,
                                             const std::atomic<bool>& stop) {
  CorrectedRun run;
  run.arguments_ = arguments;
  if (!arguments.is_wanted && arguments.learning.empty()) {
    return run;
  }
  TWIN_CHECK(check_learning(arguments, request));
  run.program_ = request.program;
  run.machine_ = request.machine;
  run.feedrate_ = request.feedrate;
  run.verbosity_ = verbosity;
  std::filesystem::path file = arguments.file;
  std::error_code ignored;
  if (const auto learnt = LearningFolder{arguments.learning}.correction();
      !arguments.learning.empty() && std::filesystem::exists(learnt, ignored)) {
    file = learnt;
  }
  if (!file.empty()) {
    TWIN_TRY(motion::Correction correction,
             runtime::read_correction(
                 file, runtime::correction_origin(run.program_, run.machine_, run.feedrate_),
                 run.machine_.compensation.limit));
    run.correction_ = std::make_shared<const motion::Correction>(std::move(correction));
  } else {
    TWIN_TRY(MadeCorrection made,
             make_shown(run.program_, run.machine_, run.feedrate_, {}, verbosity, stop));
    if (verbosity == Verbosity::kNormal) {
      print_note(made.remark());
    }
    run.correction_ = std::make_shared<const motion::Correction>(std::move(made.correction));
  }
  request.correction = run.correction_;
  if (!arguments.learning.empty()) {
    run.trace_ = std::make_unique<MemoryTrace>();
    request.sinks.push_back(run.trace_.get());
  }
  return run;
}

Expected<void> CorrectedRun::learn_from(const runtime::RunResult& result,
                                        const std::atomic<bool>& stop) {
  if (trace_ == nullptr || result.failure) {
    return {};
  }
  const LearningFolder folder{arguments_.learning};
  TWIN_TRY(const auto path, studies::compensate::ContourPath::plan(
                                program_, runtime::planned_with_reserve(machine_), feedrate_));
  std::vector<Vec2> measured(trace_->size());
  const auto x = (*trace_)["x_enc_mm"];
  const auto y = (*trace_)["y_enc_mm"];
  for (std::size_t k = 0; k < measured.size(); ++k) {
    measured[k] = {x[k], y[k]};
  }
  TWIN_TRY(auto learnt, studies::compensate::read_learnt(folder.learnt(), path.points().size()));
  TWIN_CHECK(studies::compensate::add_run(machine_, path, measured, correction_->offsets, learnt));
  TWIN_TRY(const MadeCorrection made,
           make_shown(program_, machine_, feedrate_, learnt.mismatch, verbosity_, stop));
  TWIN_CHECK(studies::compensate::write_learnt(folder.learnt(), learnt));
  TWIN_CHECK(runtime::write_correction(
      folder.correction(), made.correction,
      runtime::correction_origin(program_, machine_, feedrate_),
      fmt::format("{}; learnt from {} runs", made.remark(), learnt.runs)));
  if (verbosity_ == Verbosity::kNormal) {
    print_note(fmt::format("learnt from {} {} in {}: the next run follows {}", learnt.runs,
                           learnt.runs == 1 ? "run" : "runs", folder.folder.string(),
                           folder.correction().string()));
  }
  return {};
}

/// Correction, learning and prediction of a run.
class StudiedRun : public RunCompanion {
 public:
  StudiedRun(const RunArguments& arguments, const std::atomic<bool>& stop)
      : arguments_(arguments), stop_(stop) {}

  Expected<void> prepare(session::Request& request) override {
    const Verbosity verbosity = arguments_.results.verbosity;
    TWIN_TRY(corrected_, CorrectedRun::prepare(arguments_.correction, request, verbosity, stop_));
    return predict_errors(arguments_.tolerance, verbosity, stop_, request);
  }

  Expected<void> finish(const runtime::RunResult& result) override {
    return corrected_.learn_from(result, stop_);
  }

 private:
  const RunArguments& arguments_;
  const std::atomic<bool>& stop_;
  CorrectedRun corrected_;
};

}  // namespace

Expected<void> run_with_studies(const RunArguments& arguments, const Environment& environment) {
  StudiedRun companion(arguments, environment.stop);
  return run_program(arguments, environment, companion);
}

Expected<void> execute(const CompensateArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  TWIN_TRY(const auto program,
           read_program(arguments.program.name, arguments.machine, environment.stop));
  const std::filesystem::path file =
      !arguments.file.empty()
          ? arguments.file
          : session::result_folder({}, program.file().stem()) / "correction.csv";
  TWIN_CHECK(session::prepare_output_file(file));
  TWIN_TRY(const MadeCorrection made, make_shown(program, machine, arguments.program.feedrate, {},
                                                 arguments.verbosity, environment.stop));
  TWIN_CHECK(runtime::write_correction(
      file, made.correction,
      runtime::correction_origin(program, machine, arguments.program.feedrate), made.remark()));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}\ncorrection in {}\n", made.remark(), file.string());
  }
  return {};
}

}  // namespace twin::cli
