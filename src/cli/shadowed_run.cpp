#include "cli/shadowed_run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/atomic_file.hpp"
#include "session/results.hpp"
#include "shadow/report.hpp"

namespace twin::cli {

std::filesystem::path history_of(const std::filesystem::path& learnt,
                                 const std::filesystem::path& folder) {
  if (learnt.empty()) {
    return folder / "shadow_history.csv";
  }
  std::filesystem::path file = learnt;
  return file.replace_extension(".history.csv");
}

std::string utc_now() {
  const auto now =
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", now);
}

Expected<ShadowedRun> ShadowedRun::open(const ShadowArguments& arguments, Verbosity verbosity,
                                        session::Session& session) {
  ShadowedRun run;
  if (!arguments.is_wanted) {
    return run;
  }
  run.arguments_ = arguments;
  run.verbosity_ = verbosity;
  const config::MachineFile& machine = session.machine();
  TWIN_CHECK(shadow::check_identified(machine));
  if (session.hal() != nullptr && session.hal()->info().follows_reference) {
    return fail(ErrorCode::kUsage,
                "--shadow watches a machine with drives, and this one's position is its set point");
  }
  TWIN_TRY(const bool gives, shadow::screws_give(machine));
  shadow::Baseline baseline;
  if (!arguments.file.empty()) {
    TWIN_TRY(baseline, shadow::read_baseline(arguments.file, machine));
  } else {
    shadow::Recorded recorded;
    recorded.has_scale = machine.shadow.has_scale;
    TWIN_TRY(baseline, shadow::learn_from_model(machine, gives, {recorded, recorded}));
    if (verbosity == Verbosity::kNormal) {
      print_note(
          "the shadow knows no healthy runs of this machine, only [uncertainty] of the machine "
          "file; twin shadow --learn TRACE... makes it keener");
    }
  }
  shadow::LiveOptions options;
  options.is_wall_clock = session.is_on_wall_clock();
  options.tell = [](const std::string& line) { print_note(line); };
  run.shadow_ =
      std::make_unique<shadow::LiveShadow>(machine, std::move(baseline), gives, std::move(options));
  session.add_sink(*run.shadow_);
  return run;
}

Expected<void> ShadowedRun::finish(const session::Session& session) const {
  if (shadow_ == nullptr) {
    return {};
  }
  shadow::ShadowReport report = shadow_->report();
  TWIN_TRY(report.trends,
           shadow::add_to_history(history_of(arguments_.file, session.folder()), utc_now(),
                                  session.program().filename().string(), report));
  TWIN_CHECK(write_whole_file(session.folder() / session::kShadowName, shadow::to_json(report)));
  if (verbosity_ == Verbosity::kNormal) {
    for (const std::string& trend : report.trends) {
      print_note(trend);
    }
  }
  return {};
}

}  // namespace twin::cli
