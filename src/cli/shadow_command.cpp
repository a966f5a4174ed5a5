#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/machines.hpp"
#include "cli/shadowed_run.hpp"
#include "cli/study_commands.hpp"
#include "core/atomic_file.hpp"
#include "session/results.hpp"
#include "shadow/report.hpp"
#include "studies/shadow/recorded_track.hpp"

// The command shadow: learns of recorded runs, or watches them.
namespace twin::cli {
namespace {

Expected<std::vector<shadow::Track>> read_tracks(const ShadowCommandArguments& arguments,
                                                 const config::MachineFile& machine) {
  TWIN_TRY(const auto columns, studies::identify::parse_columns(arguments.columns));
  std::vector<shadow::Track> tracks;
  for (const std::string& trace : arguments.traces) {
    TWIN_TRY(auto some, studies::shadow::read_tracks(trace, columns, machine));
    std::ranges::move(some, std::back_inserter(tracks));
  }
  return tracks;
}

Expected<void> learn_tracks(const ShadowCommandArguments& arguments,
                            const config::MachineFile& machine,
                            const std::vector<shadow::Track>& tracks, bool gives) {
  const std::filesystem::path file = session::result_folder(arguments.file, "shadow/learnt.json");
  TWIN_CHECK(session::prepare_output_file(file));
  TWIN_TRY(const shadow::Baseline baseline, shadow::learn(machine, tracks, gives));
  TWIN_CHECK(shadow::write_baseline(file, baseline));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}learnt from {:.1f} s of {} {}: {}\n", shadow::to_text(baseline, machine),
              baseline.seconds, tracks.size(), tracks.size() == 1 ? "recording" : "recordings",
              file.string());
  }
  return {};
}

/// What a shadow is compared with, where nothing was learnt.
Expected<shadow::Baseline> baseline_of(const ShadowCommandArguments& arguments,
                                       const config::MachineFile& machine,
                                       const shadow::Track& track, bool gives) {
  if (!arguments.learnt.empty()) {
    return shadow::read_baseline(arguments.learnt, machine);
  }
  return shadow::learn_from_model(machine, gives, track.recorded);
}

Expected<void> watch_track(const ShadowCommandArguments& arguments,
                           const config::MachineFile& machine, const shadow::Track& track,
                           bool gives, const std::filesystem::path& file) {
  TWIN_TRY(const shadow::Baseline baseline, baseline_of(arguments, machine, track, gives));
  TWIN_CHECK(shadow::check_signals(baseline, track, machine));
  shadow::Shadow watcher(machine, baseline, gives, machine.shadow.hours, track.recorded);
  for (const shadow::ShadowSample& sample : track.samples) {
    watcher.step(sample);
  }
  shadow::ShadowReport report = shadow::make_report(watcher, baseline, machine);
  report.periods = static_cast<std::int64_t>(track.samples.size());
  if (watcher.has_failed()) {
    report.switched_off = "its model is not finite any more";
  }
  TWIN_CHECK(write_whole_file(file, shadow::to_json(report)));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}\n{}shadow in {}\n", track.name, shadow::to_text(report), file.string());
  }
  if (watcher.has_failed()) {
    return fail(ErrorCode::kMachine,
                fmt::format("{}: the model of {} does not stay finite on these drive commands",
                            track.name, machine.name));
  }
  return {};
}

/// Where the report on a trace goes: beside it, or as --out says.
std::filesystem::path report_of(const ShadowCommandArguments& arguments, const shadow::Track& track,
                                std::size_t number) {
  std::filesystem::path file =
      arguments.file.empty()
          ? std::filesystem::path(track.name).parent_path() / session::kShadowName
          : arguments.file;
  if (number > 0) {
    const std::string stem = file.stem().string();
    file.replace_filename(fmt::format("{}_{}{}", stem, number + 1, file.extension().string()));
  }
  return file;
}

}  // namespace

Expected<void> execute(const ShadowCommandArguments& arguments, const Environment&) {
  TWIN_TRY(config::MachineFile machine, read_machine(arguments.machine, arguments.verbosity));
  TWIN_CHECK(shadow::check_identified(machine));
  TWIN_TRY(const std::vector<shadow::Track> tracks, read_tracks(arguments, machine));
  TWIN_TRY(const bool gives, shadow::screws_give(machine));
  if (arguments.is_learning) {
    if (!arguments.learnt.empty()) {
      return fail(ErrorCode::kUsage, "--learn makes a new file (--out): leave out --learnt");
    }
    return learn_tracks(arguments, machine, tracks, gives);
  }
  std::vector<std::filesystem::path> taken;
  for (const shadow::Track& track : tracks) {
    const auto first = report_of(arguments, track, 0);
    const auto number = static_cast<std::size_t>(std::ranges::count(taken, first));
    taken.push_back(first);
    const std::filesystem::path file = report_of(arguments, track, number);
    TWIN_CHECK(session::prepare_output_file(file));
    TWIN_CHECK(watch_track(arguments, machine, track, gives, file));
  }
  return {};
}

}  // namespace twin::cli
