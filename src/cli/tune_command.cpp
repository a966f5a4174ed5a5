#include <fmt/format.h>

#include "cli/machines.hpp"
#include "cli/study_commands.hpp"
#include "cli/terminal.hpp"
#include "session/results.hpp"
#include "studies/tune/tune.hpp"
#include "studies/tune/tune_report.hpp"

// The command twin tune.
namespace twin::cli {
namespace {

namespace tune = studies::tune;

/// What is to be tuned. @param machine  with its own settings
Expected<tune::Task> task_of(const TuneArguments& arguments, const config::MachineFile& machine) {
  tune::Task task;
  task.programs = arguments.programs;
  task.machine = arguments.machine.file;
  task.settings = arguments.machine.settings;
  task.feedrate = arguments.feedrate;
  task.aim = arguments.aim == "time" ? tune::Aim::kTime : tune::Aim::kContourError;
  task.margins = {.gain_dB = arguments.gain_margin, .phase_deg = arguments.phase_margin};
  for (const std::string& range : arguments.ranges) {
    TWIN_TRY(tune::VariedKey key, tune::parse_varied_key(range));
    task.keys.push_back(std::move(key));
  }
  if (task.keys.empty()) {
    task.keys = tune::usual_keys(machine, task.aim);
  }
  if (arguments.largest_error && task.aim == tune::Aim::kContourError) {
    return fail(ErrorCode::kUsage, "--within-um is for --for time");
  }
  task.largest_error = arguments.largest_error.value_or(0.0);
  return task;
}

/// The contour error that the machine file's own settings have.
Expected<double> own_error(const tune::Task& task, const studies::batch::Store& store,
                           const std::atomic<bool>& stop) {
  tune::Evaluator evaluator(task, store, &stop);
  TWIN_TRY(const tune::Trial own, evaluator.run_values({}, {}, task.programs));
  for (const studies::batch::Row& row : own.rows) {
    if (!row.result.failure.empty()) {
      return fail(ErrorCode::kMachine, row.result.failure);
    }
  }
  return own.merit.contour_error;
}

std::string progress_text(const tune::Progress& at, tune::Aim aim) {
  if (!(at.cost < 1e9)) {  // nothing yet keeps margins and error
    return fmt::format("{} of {} trials", at.done, at.trials);
  }
  return fmt::format("{} of {} trials, {:.4g} {}", at.done, at.trials, at.cost,
                     aim == tune::Aim::kTime ? "s" : "um");
}

}  // namespace

Expected<void> execute(const TuneArguments& arguments, const Environment& environment) {
  const Verbosity verbosity = arguments.run.verbosity;
  TWIN_TRY(const config::MachineFile machine, read_machine(arguments.machine, verbosity));
  TWIN_TRY(tune::Task task, task_of(arguments, machine));
  const std::filesystem::path out = session::result_folder(
      arguments.folder,
      std::filesystem::path(arguments.programs.front()).stem().string() + "_tune");
  TWIN_TRY(const auto store,
           studies::batch::Store::open(arguments.run.store.empty() ? out / "store"
                                                                   : arguments.run.store));
  if (task.aim == tune::Aim::kTime && !arguments.largest_error) {
    TWIN_TRY(task.largest_error, own_error(task, store, environment.stop));
  }
  Expected<tune::Tuning> tuning;
  {
    Progress progress("tuning", verbosity);
    tune::Options options{.trials = arguments.trials,
                          .seed = arguments.seed,
                          .workers = arguments.run.workers,
                          .further_programs = arguments.further,
                          .stop = &environment.stop};
    options.progress = [&](const tune::Progress& at) {
      progress.rename(progress_text(at, task.aim));
      progress.show(static_cast<double>(at.done) / static_cast<double>(at.trials));
    };
    tuning = tune::tune(task, store, options);
  }
  if (!tuning) {
    return tl::unexpected(tuning.error());
  }
  TWIN_CHECK(tune::write_tuning(task, *tuning, out));
  if (verbosity == Verbosity::kNormal) {
    print_out("{}\nmachine file: {}; all trials: {}\n", tune::to_table(task, *tuning),
              (out / "best.toml").string(), (out / "index.html").string());
  }
  return {};
}

}  // namespace twin::cli
