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
#include "core/stop_wish.hpp"
#include "session/results.hpp"
#include "shadow/report.hpp"
#include "studies/shadow/recorded_track.hpp"
#include "studies/shadow/watched_track.hpp"

// The command shadow: learns of recorded runs, or watches them.
namespace twin::cli {
namespace {

Expected<std::vector<shadow::Track>> read_tracks(const ShadowCommandArguments& arguments,
                                                 const config::MachineFile& machine,
                                                 const std::atomic<bool>& stop) {
  TWIN_TRY(const auto columns, studies::identify::parse_columns(arguments.columns));
  std::vector<shadow::Track> tracks;
  for (const std::string& trace : arguments.traces) {
    TWIN_CHECK(check_wish(&stop, "interrupted"));
    TWIN_TRY(auto some, studies::shadow::read_tracks(trace, columns, machine));
    std::ranges::move(some, std::back_inserter(tracks));
  }
  return tracks;
}

Expected<void> learn_tracks(const ShadowCommandArguments& arguments,
                            const config::MachineFile& machine,
                            const std::vector<shadow::Track>& tracks, bool gives,
                            const std::atomic<bool>& stop) {
  const std::filesystem::path file = session::result_folder(arguments.file, "shadow/learnt.json");
  TWIN_CHECK(session::prepare_output_file(file));
  TWIN_TRY(const shadow::Baseline baseline, shadow::learn(machine, tracks, gives, &stop));
  TWIN_CHECK(shadow::write_baseline(file, baseline));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}learnt from {:.1f} s of {} {}: {}\n", shadow::to_text(baseline, machine),
              baseline.seconds, tracks.size(), tracks.size() == 1 ? "recording" : "recordings",
              file.string());
  }
  return {};
}

Expected<void> watch_track(const ShadowCommandArguments& arguments,
                           const config::MachineFile& machine, const shadow::Track& track,
                           bool gives, const std::filesystem::path& file,
                           const std::atomic<bool>& stop) {
  TWIN_TRY(const shadow::ShadowReport report,
           studies::shadow::watch_track(machine, track, arguments.learnt, gives, &stop));
  TWIN_CHECK(write_whole_file(file, shadow::to_json(report)));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}\n{}shadow in {}\n", track.name, shadow::to_text(report), file.string());
  }
  if (!report.switched_off.empty()) {
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

Expected<void> execute(const ShadowCommandArguments& arguments, const Environment& environment) {
  TWIN_TRY(config::MachineFile machine, read_machine(arguments.machine, arguments.verbosity));
  TWIN_CHECK(shadow::check_identified(machine));
  TWIN_TRY(const std::vector<shadow::Track> tracks,
           read_tracks(arguments, machine, environment.stop));
  TWIN_TRY(const bool gives, shadow::screws_give(machine));
  if (arguments.is_learning) {
    if (!arguments.learnt.empty()) {
      return fail(ErrorCode::kUsage, "--learn makes a new file (--out): leave out --learnt");
    }
    return learn_tracks(arguments, machine, tracks, gives, environment.stop);
  }
  std::vector<std::filesystem::path> taken;
  for (const shadow::Track& track : tracks) {
    const auto first = report_of(arguments, track, 0);
    const auto number = static_cast<std::size_t>(std::ranges::count(taken, first));
    taken.push_back(first);
    const std::filesystem::path file = report_of(arguments, track, number);
    TWIN_CHECK(session::prepare_output_file(file));
    TWIN_CHECK(watch_track(arguments, machine, track, gives, file, environment.stop));
  }
  return {};
}

}  // namespace twin::cli
