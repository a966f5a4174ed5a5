#include "twin/run.hpp"

#include <algorithm>

#include "library/inside.hpp"
#include "results/trace/hdf5_trace.hpp"
#include "session/session.hpp"

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
  session::Session session =
      value_of(session::Session::open(request_of(program, settings, machine, options)));
  session::Attendance attendance;
  attendance.stop = options.stop;
  if (options.panel != nullptr) {
    attendance.panel = &Inside::of(*options.panel).panel;
    attendance.stop = &Inside::of(*options.panel).stop;
  }
  attendance.progress = options.progress;
  const runtime::RunResult result = value_of(session.run(attendance));
  return {Inside::summary(result.summary, session.machine().limits), result.failure};
}

}  // namespace twin
