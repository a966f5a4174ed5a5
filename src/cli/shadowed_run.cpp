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
  shadow::LiveOptions options;
  options.is_wall_clock = session.is_on_wall_clock();
  options.tell = [](const std::string& line) { print_note(line); };
  TWIN_TRY(run.shadow_, shadow::make_live_shadow(machine, arguments.file, std::move(options)));
  if (arguments.file.empty() && verbosity == Verbosity::kNormal) {
    print_note(
        "the shadow knows no healthy runs of this machine, only [uncertainty] of the machine "
        "file; twin shadow --learn TRACE... makes it keener");
  }
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
