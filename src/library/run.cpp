#include "twin/run.hpp"

#include <algorithm>

#include "core/atomic_file.hpp"
#include "library/inside.hpp"
#include "results/trace/hdf5_trace.hpp"
#include "session/results.hpp"
#include "session/session.hpp"
#include "shadow/live_shadow.hpp"
#include "studies/compensate/corrected_run.hpp"

namespace twin {
namespace {

static_assert(static_cast<int>(runtime::MotionState::kEnded) ==
              static_cast<int>(Panel::State::kEnded));

session::Request request_of(const Program& program, const Settings& settings, Machine& machine,
                            const RunOptions& options) {
  session::Request request;
  request.program = Inside::of(program).source;
  request.feedrate = Inside::of(program).feedrate;
  request.machine = Inside::of(settings);
  request.hal = &machine;
  request.folder = options.folder;
  request.files = options.folder.empty() ? session::Files::kNone : session::Files::kWritten;
  const auto files = results::trace_files_of(options.trace_files);
  if (!files) {
    throw Failure(
        {ErrorCode::kUsage,
         "trace_files is \"" + options.trace_files + "\"; expected csv, hdf5, both or none",
         {},
         0,
         0});
  }
  request.trace = *files;
  request.sinks = options.sinks;
  request.pace = options.is_wall_clock ? session::Pace::kWallClock : session::Pace::kOwn;
  request.servo = options.servo;
  for (const OverrideChange& change : options.overrides) {
    request.overrides.push_back({change.time, change.percent});
  }
  return request;
}

/// The correction of RunOptions::correction and RunOptions::learning, in the request.
studies::compensate::CorrectedRun correct(const RunOptions& options, session::Request& request) {
  if (!options.learning.empty() && (!options.correction.empty() || !options.overrides.empty())) {
    throw Failure({ErrorCode::kUsage,
                   "a run that is learnt from has its own correction and its programmed feedrate: "
                   "leave out correction and overrides",
                   {},
                   0,
                   0});
  }
  auto corrected = value_of(studies::compensate::CorrectedRun::prepare(
      {!options.correction.empty(), options.correction, options.learning}, request.program,
      request.machine, request.feedrate, {options.stop, {}}));
  corrected.add_to(request);
  return corrected;
}

/// The shadow of RunOptions::has_shadow, as a sink of the session; else null.
std::unique_ptr<shadow::LiveShadow> add_shadow(const RunOptions& options,
                                               session::Session& session) {
  if (!options.has_shadow) {
    return nullptr;
  }
  const config::MachineFile& machine = session.machine();
  check(shadow::check_identified(machine));
  if (session.hal()->info().follows_reference) {
    throw Failure(
        {ErrorCode::kUsage,
         "a shadow watches a machine with drives, and this one's position is its set point",
         {},
         0,
         0});
  }
  shadow::LiveOptions live;
  live.is_wall_clock = session.is_on_wall_clock();
  auto made = value_of(shadow::make_live_shadow(machine, options.shadow_learnt, std::move(live)));
  session.add_sink(*made);
  return made;
}

}  // namespace

Panel::Panel() : data_(std::make_unique<Data>()) {}
Panel::~Panel() = default;
void Panel::set_override(double percent) noexcept { data_->panel.set_override(percent); }
void Panel::hold() noexcept { data_->panel.hold(true); }
void Panel::resume() noexcept { data_->panel.hold(false); }
void Panel::stop() noexcept { data_->stop = true; }

Panel::Display Panel::display() const noexcept {
  const runtime::OperatorPanel::Display shown = data_->panel.display();
  return {static_cast<State>(shown.state), shown.time, shown.percent, shown.feedrate, shown.line};
}

void write_hdf5(const MemoryTrace& trace, const Program& program, const Settings& settings,
                const std::string& summary, const std::string& folder) {
  const gcode::ProgramText& text = Inside::of(program).source;
  check(make_folder(folder));
  results::Hdf5Trace file(folder, {.program = text.file().filename().string(),
                                   .program_sha256 = text.sha256(),
                                   .settings = config::to_toml(Inside::of(settings))});
  file.set_summary(results::reproducible(summary));
  const auto check_call = [](std::optional<Error> error) { check(checked(std::move(error))); };
  const TraceHeader& header = trace.header();
  check_call(file.begin(header));
  std::vector<std::span<const double>> columns;
  for (const TraceColumn& column : header.columns) {
    columns.push_back(trace[column.name]);
  }
  std::vector<double> row(columns.size());
  for (std::size_t i = 0; i < trace.size(); ++i) {
    std::ranges::transform(columns, row.begin(), [i](const auto& column) { return column[i]; });
    check_call(file.rows(row));
  }
  if (trace.is_complete()) {
    check_call(file.commit());
  } else {
    file.abandon();
  }
}

Run run(const Program& program, const Settings& settings, Machine& machine,
        const RunOptions& options) {
  session::Request request = request_of(program, settings, machine, options);
  studies::compensate::CorrectedRun corrected = correct(options, request);
  session::Session session = value_of(session::Session::open(std::move(request)));
  const auto watching = add_shadow(options, session);
  session::Attendance attendance;
  attendance.stop = options.stop;
  if (options.panel != nullptr) {
    attendance.panel = &Inside::of(*options.panel).panel;
    attendance.stop = &Inside::of(*options.panel).stop;
  }
  attendance.progress = options.progress;
  const runtime::RunResult result = value_of(session.run(attendance));
  Run run{Inside::summary(result.summary, session.machine().limits), result.failure};
  if (watching != nullptr) {
    run.shadow = Inside::report(watching->report(), {});
    if (!options.folder.empty()) {
      check(write_whole_file(session.folder() / session::kShadowName, run.shadow->json));
    }
  }
  if (!result.failure) {
    value_of(corrected.learn_from({options.stop, {}}));
  }
  return run;
}

}  // namespace twin
