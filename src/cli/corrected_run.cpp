#include "cli/corrected_run.hpp"

#include <fmt/format.h>

#include <atomic>
#include <string>

#include "cli/machines.hpp"
#include "cli/predictions.hpp"
#include "cli/run_command.hpp"
#include "cli/study_commands.hpp"
#include "cli/terminal.hpp"
#include "runtime/correction_file.hpp"
#include "session/results.hpp"
#include "studies/compensate/corrected_run.hpp"

// Corrections of set points: twin compensate, run --compensate, run --learn.
namespace twin::cli {
namespace {

using studies::compensate::CorrectedRun;
using studies::compensate::MadeCorrection;

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
  return {};
}

/// Correction, learning and prediction of a run.
class StudiedRun : public RunCompanion {
 public:
  StudiedRun(const RunArguments& arguments, const std::atomic<bool>& stop)
      : arguments_(arguments), verbosity_(arguments.results.verbosity), stop_(stop) {}

  Expected<void> prepare(session::Request& request) override {
    TWIN_CHECK(correct(request));
    return predict_errors(arguments_.tolerance, verbosity_, stop_, request);
  }

  /// A run that ended early is not learnt from.
  Expected<void> finish(const runtime::RunResult& result) override {
    if (result.failure) {
      return {};
    }
    std::string line;
    {
      Progress progress("correcting", verbosity_);
      TWIN_TRY(line, corrected_.learn_from({&stop_, progress.callback()}));
    }
    note(line);
    return {};
  }

 private:
  Expected<void> correct(session::Request& request) {
    const CorrectionArguments& wish = arguments_.correction;
    TWIN_CHECK(check_learning(wish, request));
    {
      Progress progress("correcting", verbosity_);
      TWIN_TRY(corrected_, CorrectedRun::prepare({wish.is_wanted, wish.file, wish.learning},
                                                 request.program, request.machine, request.feedrate,
                                                 {&stop_, progress.callback()}));
    }
    note(corrected_.remark());
    corrected_.add_to(request);
    return {};
  }
  void note(const std::string& line) const {
    if (verbosity_ == Verbosity::kNormal && !line.empty()) {
      print_note(line);
    }
  }

  const RunArguments& arguments_;
  Verbosity verbosity_;
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
  MadeCorrection made;
  {
    Progress progress("correcting", arguments.verbosity);
    studies::compensate::CompensateOptions options;
    options.stop = &environment.stop;
    options.progress = progress.callback();
    TWIN_TRY(made, studies::compensate::make_correction(program, machine,
                                                        arguments.program.feedrate, options));
  }
  TWIN_CHECK(runtime::write_correction(
      file, made.correction,
      runtime::correction_origin(program, machine, arguments.program.feedrate), made.remark()));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}\ncorrection in {}\n", made.remark(), file.string());
  }
  return {};
}

}  // namespace twin::cli
