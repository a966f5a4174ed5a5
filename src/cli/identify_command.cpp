#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "cli/commands.hpp"
#include "cli/identify_options.hpp"
#include "cli/identify_tables.hpp"
#include "cli/progress.hpp"
#include "config/nearest_name.hpp"
#include "core/atomic_file.hpp"
#include "session/results.hpp"
#include "studies/identify/identify.hpp"
#include "studies/identify/parameter.hpp"
#include "studies/identify/report.hpp"

namespace twin::cli {
namespace {

/// Full keys from "a,b" texts; each must be one that can be fitted.
Expected<std::vector<std::string>> keys_of(const std::vector<std::string>& names,
                                           const config::MachineFile& machine) {
  std::vector<studies::identify::Parameter> known;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    for (const studies::identify::Candidate& candidate :
         studies::identify::axis_candidates(machine, axis)) {
      known.push_back(candidate.parameter);
    }
    const std::string name = axis == hal::kX ? "x" : "y";
    for (const char* key : {"kd", "trim_V"}) {
      known.push_back({"servo." + name + "." + key, 0.0, 1.0});
    }
    known.push_back({"table." + name + ".encoder_um_per_count", 0.0, 1.0});
  }
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    const auto found =
        std::ranges::find_if(known, [&](const studies::identify::Parameter& parameter) {
          return parameter.key == name || parameter.key.starts_with(name + "_");
        });
    if (found == known.end()) {
      std::vector<std::string> candidates;
      candidates.reserve(known.size());
      for (const studies::identify::Parameter& parameter : known) {
        candidates.push_back(parameter.key);
      }
      return fail(ErrorCode::kUsage,
                  fmt::format("--fix, --free: {} is nothing that a trace is fitted for{}", name,
                              config::did_you_mean(name, candidates)));
    }
    keys.push_back(found->key);
  }
  return keys;
}

Expected<std::vector<studies::identify::Recording>> read_all(const IdentifyOptions& options,
                                                             const config::MachineFile& machine) {
  const auto columns = studies::identify::parse_columns(options.columns);
  if (!columns) {
    return tl::unexpected(columns.error());
  }
  std::vector<studies::identify::Recording> recordings;
  for (const std::string& trace : options.traces) {
    auto recording = studies::identify::read_recording(trace, *columns, machine.limits);
    if (!recording) {
      return tl::unexpected(recording.error());
    }
    recordings.push_back(std::move(*recording));
  }
  return recordings;
}

/// Writes the machine file and identify.json beside it.
Expected<void> write_results(const studies::identify::Identification& result,
                             const std::filesystem::path& out) {
  if (auto written = write_whole_file(out, studies::identify::to_machine_file(result)); !written) {
    return written;
  }
  return write_whole_file(out.parent_path() / "identify.json",
                          studies::identify::to_json(result, out));
}

/// Where the machine file goes.
std::filesystem::path output_of(const Options& options) {
  return options.out.empty() ? std::filesystem::path("renders/identify/identified.toml")
                             : options.out;
}

Expected<void> identify_traces(const Options& options, const IdentifyOptions& identify_options,
                               const config::MachineFile& machine, const std::atomic<bool>& stop) {
  studies::identify::FitOptions fit;
  fit.evaluations = identify_options.evaluations.value_or(fit.evaluations);
  fit.seed = identify_options.seed;
  fit.stop = &stop;
  auto fixed = keys_of(identify_options.fixed, machine);
  auto freed = keys_of(identify_options.freed, machine);
  if (!fixed || !freed) {
    return tl::unexpected(fixed ? freed.error() : fixed.error());
  }
  fit.fixed = std::move(*fixed);
  fit.freed = std::move(*freed);
  const auto recordings = read_all(identify_options, machine);
  if (!recordings) {
    return tl::unexpected(recordings.error());
  }
  Expected<studies::identify::Identification> result;
  {
    Progress progress("identifying", options.quiet);
    fit.progress = progress.callback();
    result = studies::identify::identify(*recordings, machine, fit);
  }
  if (!result) {
    return tl::unexpected(result.error());
  }
  const std::filesystem::path out = output_of(options);
  if (auto written = write_results(*result, out); !written) {
    return written;
  }
  if (!options.quiet) {
    fmt::print("{}\nmachine file {}, details in {}\n", studies::identify::to_table(*result),
               out.string(), (out.parent_path() / "identify.json").string());
  }
  for (const std::string& note : result->notes) {
    fmt::print(stderr, "twin: note: {}\n", note);
  }
  return {};
}

Expected<void> identify_command(const Options& options, const IdentifyOptions& identify,
                                const std::atomic<bool>& stop) {
  if (identify.tables != identify.traces.empty()) {
    return fail(ErrorCode::kUsage, identify.tables
                                       ? "identify takes traces or --tables, not both"
                                       : "identify wants traces, or --tables; see twin identify "
                                         "--help");
  }
  const auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  if (auto prepared = session::prepare_output_file(output_of(options)); !prepared) {
    return prepared;
  }
  if (!identify.tables) {
    return identify_traces(options, identify, *machine, stop);
  }
  IdentifyTables request;
  request.start = *machine;
  request.out = output_of(options);
  request.evaluations = identify.evaluations.value_or(request.evaluations);
  request.seed = identify.seed;
  request.quiet = options.quiet;
  return identify_tables(request, stop);
}

}  // namespace

Command add_identify(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "identify", "Fit the machine's parameters to recorded traces, and say which are shown");
  const auto identify = std::make_shared<IdentifyOptions>();
  add_identify_options(*app, options, *identify);
  return {app, [&options, identify, &stop = context.stop] {
            return identify_command(options, *identify, stop);
          }};
}

}  // namespace twin::cli
