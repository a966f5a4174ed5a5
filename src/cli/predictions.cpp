#include "cli/predictions.hpp"

#include <fmt/format.h>

#include <span>

#include "cli/machines.hpp"
#include "cli/study_commands.hpp"
#include "core/atomic_file.hpp"
#include "runtime/correction_file.hpp"
#include "session/results.hpp"
#include "studies/predict/fastest.hpp"

// What may come of a run: run --tolerance-um, twin fastest.
namespace twin::cli {

namespace predict = studies::predict;

Expected<void> predict_errors(const std::optional<double>& tolerance, Verbosity verbosity,
                              const std::atomic<bool>& stop, session::Request& request) {
  if (!tolerance) {
    return {};
  }
  if (!request.overrides.empty()) {
    return fail(ErrorCode::kUsage,
                "--tolerance-um is about the programmed feedrate: leave out --override");
  }
  const bool is_corrected = request.correction != nullptr;
  TWIN_TRY(const predict::Uncertainty uncertainty, predict::Uncertainty::of(request.machine));
  TWIN_TRY(const auto path,
           studies::compensate::ContourPath::plan(
               request.program,
               is_corrected ? runtime::planned_with_reserve(request.machine) : request.machine,
               request.feedrate));
  std::span<const Vec2> offsets;
  if (is_corrected && request.correction->offsets.size() == path.points().size()) {
    offsets = request.correction->offsets;
  }
  Progress progress("predicting", verbosity);
  predict::ToleranceOptions options;
  options.stop = &stop;
  options.progress = progress.callback();
  TWIN_TRY(const auto errors, predict::possible_errors(path, uncertainty, offsets, {}, options));
  const std::string text = predict::predict(errors.largest, *tolerance).text();
  if (verbosity == Verbosity::kNormal) {
    print_note(text);
  }
  request.machine.add_note("predicted: " + text);
  return {};
}

Expected<void> execute(const FastestArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  TWIN_TRY(const auto program,
           read_program(arguments.program, arguments.machine, environment.stop));
  const std::filesystem::path file =
      !arguments.file.empty() ? arguments.file
                              : session::result_folder({}, program.file().stem()) / "fastest.nc";
  TWIN_CHECK(session::prepare_output_file(file));
  predict::FastestOptions options;
  options.tolerance = arguments.tolerance;
  options.stop = &environment.stop;
  if (arguments.verbosity == Verbosity::kNormal) {
    options.tell = [](const std::string& what) { print_note(what); };
  }
  TWIN_TRY(const predict::Fastest found, predict::fastest(program, machine, options));
  if (found.stretches) {
    TWIN_CHECK(write_whole_file(file, found.program));
  }
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}", predict::to_table(found, options));
    if (found.stretches) {
      print_out("program with {} feedrates in {}\n", found.schedule.size(), file.string());
    }
  }
  return {};
}

}  // namespace twin::cli
