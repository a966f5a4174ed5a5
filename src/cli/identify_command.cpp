#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/machines.hpp"
#include "cli/study_commands.hpp"
#include "core/atomic_file.hpp"
#include "session/results.hpp"
#include "studies/identify/candidates.hpp"
#include "studies/identify/identification_report.hpp"
#include "studies/identify/identify.hpp"
#include "studies/identify/validation_figures.hpp"
#include "studies/reproduce/table_fit.hpp"

namespace twin::cli {
namespace {

Expected<std::vector<studies::identify::Recording>> read_recordings(
    const std::vector<std::string>& traces, const IdentifyArguments& arguments,
    const config::MachineFile& machine) {
  TWIN_TRY(const auto columns, studies::identify::parse_columns(arguments.columns));
  std::vector<studies::identify::Recording> recordings;
  for (const std::string& trace : traces) {
    TWIN_TRY(auto some, studies::identify::read_recordings(trace, columns, machine.limits));
    std::ranges::move(some, std::back_inserter(recordings));
  }
  return recordings;
}

/// The full keys that an option has named.
Expected<std::vector<std::string>> keys_of(const std::string& option,
                                           const std::vector<std::string>& names,
                                           const config::MachineFile& machine) {
  return studies::identify::full_keys(names, machine).map_error([&](Error error) {
    error.message = option + ": " + error.message;
    return error;
  });
}

/// Fits the machine to traces, writes the machine file, and identify.json beside it.
Expected<void> identify_traces(const IdentifyArguments& arguments,
                               const config::MachineFile& machine,
                               const std::filesystem::path& file, const std::atomic<bool>& stop) {
  studies::identify::FitOptions fit;
  fit.evaluations = arguments.evaluations.value_or(fit.evaluations);
  fit.seed = arguments.seed;
  fit.stop = &stop;
  TWIN_TRY(fit.fixed, keys_of("--fix", arguments.fixed, machine));
  TWIN_TRY(fit.freed, keys_of("--free", arguments.freed, machine));
  TWIN_TRY(auto recordings, read_recordings(arguments.traces, arguments, machine));
  TWIN_TRY(auto at_table, read_recordings(arguments.at_table, arguments, machine));
  for (studies::identify::Recording& recording : at_table) {
    recording.is_at_table = true;
    recordings.push_back(std::move(recording));
  }
  TWIN_TRY(const auto validating, read_recordings(arguments.validating, arguments, machine));
  Expected<studies::identify::Identification> result;
  {
    Progress progress("identifying", arguments.verbosity);
    fit.progress = progress.callback();
    result = studies::identify::identify(recordings, machine, fit, validating);
  }
  if (!result) {
    return tl::unexpected(result.error());
  }
  const std::filesystem::path details = file.parent_path() / "identify.json";
  TWIN_CHECK(write_whole_file(file, studies::identify::to_machine_file(*result)));
  TWIN_CHECK(write_whole_file(details, studies::identify::to_json(*result, file)));
  if (arguments.has_plots) {
    TWIN_CHECK(
        studies::identify::draw_validations(result->validations, file.parent_path() / "plots"));
  }
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}\nmachine file {}, details in {}\n", studies::identify::to_table(*result),
              file.string(), details.string());
  }
  for (const std::string& note : result->notes) {
    print_note(note);
  }
  return {};
}

/// Fits the machine to the published tables and writes the machine file. Interrupted, it writes the
/// best so far.
Expected<void> identify_tables(const IdentifyArguments& arguments,
                               const config::MachineFile& machine,
                               const std::filesystem::path& file, const std::atomic<bool>& stop) {
  TWIN_TRY(const auto published, studies::reproduce::published());
  const std::filesystem::path checkpoint = file.string() + ".checkpoint";
  Expected<studies::reproduce::TableFit> fit;
  {
    Progress progress("fitting the published tables", arguments.verbosity);
    studies::reproduce::TableFitOptions options;
    options.evaluations = arguments.evaluations.value_or(options.evaluations);
    options.seed = arguments.seed;
    options.stop = &stop;
    options.checkpoint = checkpoint;
    options.progress = [&progress](double share, double) { progress.show(share); };
    fit = studies::reproduce::fit_tables(published, machine, options);
  }
  if (!fit) {
    return tl::unexpected(fit.error());
  }
  fit->machine.table.is_identified = true;
  TWIN_CHECK(write_whole_file(file, config::to_toml(fit->machine)));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}machine file: {}\n", studies::reproduce::to_table(*fit), file.string());
  }
  if (fit->was_resumed) {
    print_note(fmt::format("went on from {}", checkpoint.string()));
  }
  if (fit->was_stopped) {
    return fail(ErrorCode::kInterrupted,
                "interrupted: the machine file has the best so far; the same command goes on");
  }
  std::error_code ignored;
  std::filesystem::remove(checkpoint, ignored);
  return {};
}

}  // namespace

Expected<void> execute(const IdentifyArguments& arguments, const Environment& environment) {
  const bool has_traces = !arguments.traces.empty() || !arguments.at_table.empty();
  if (arguments.has_tables == has_traces) {
    return fail(ErrorCode::kUsage, arguments.has_tables
                                       ? "identify takes traces or --tables, not both"
                                       : "identify wants traces, or --tables; see twin identify "
                                         "--help");
  }
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  const std::filesystem::path file =
      session::result_folder(arguments.file, "identify/identified.toml");
  TWIN_CHECK(session::prepare_output_file(file));
  return arguments.has_tables ? identify_tables(arguments, machine, file, environment.stop)
                              : identify_traces(arguments, machine, file, environment.stop);
}

}  // namespace twin::cli
