#include "session/session.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "core/units.hpp"
#include "runtime/program_bound.hpp"
#include "runtime/run_options.hpp"
#include "session/report.hpp"
#include "session/results.hpp"

namespace twin::session {

Session::Session(Request request, std::unique_ptr<hal::Machine> made)
    : request_(std::move(request)),
      made_(std::move(made)),
      hal_(made_ ? made_.get() : request_.hal) {
  request_.folder = result_folder(request_.folder, program().stem());
}

Expected<Session> Session::open(Request request) {
  std::unique_ptr<hal::Machine> made;
  if (request.hal == nullptr && request.make_machine) {
    TWIN_TRY(made, request.make_machine(request.machine,
                                        "run " + request.program.file().filename().string()));
  }
  return Session(std::move(request), std::move(made));
}

bool Session::is_on_wall_clock() const noexcept {
  return request_.pace == Pace::kWallClock || (hal_ != nullptr && hal_->info().keeps_own_time);
}

std::filesystem::path Session::trace_file() const {
  const bool is_hdf5 = request_.trace == results::TraceFiles::kHdf5;
  if (is_partial_) {
    return request_.folder /
           (is_hdf5 ? results::kPartialHdf5TraceName : results::kPartialTraceName);
  }
  return request_.folder / (is_hdf5 ? results::kHdf5TraceName : results::kTraceName);
}

std::string Session::title() const {
  const std::string name = program().filename().string();
  return request_.feedrate ? fmt::format("{}, {:g} mm/min", name,
                                         units::mm_per_min_from_mm_per_s(*request_.feedrate))
                           : name;
}

Expected<runtime::RunResult> Session::run(const Attendance& attendance) {
  runtime::RunRequest run;
  run.program = request_.program;
  run.machine = request_.machine;
  run.hal = hal_;
  run.feedrate = request_.feedrate;
  run.directory = request_.files == Files::kWritten ? request_.folder : std::filesystem::path();
  run.sinks = request_.sinks;
  run.trace = request_.trace;
  if (!request_.columns.empty()) {
    TWIN_TRY(run.columns,
             results::choose_columns(
                 request_.columns, hal_ == nullptr ? results::Layout::kPlan : results::Layout::kRun,
                 hal_ != nullptr && hal_->info().has_forces));
  }
  run.servo = request_.servo;
  run.is_wall_clock = is_on_wall_clock();
  run.overrides = request_.overrides;
  run.until = request_.until;
  run.correction = request_.correction.get();
  run.command = request_.command;
  run.stop = attendance.stop;
  run.panel = attendance.panel;
  run.progress = attendance.progress;
  run.estimated = attendance.estimated;
  run.noted = attendance.noted;
  TWIN_TRY(runtime::RunResult result, runtime::run_program(run));
  if (request_.has_bound && !result.failure) {
    TWIN_TRY(result.summary.time_bound, runtime::time_bound(request_.program, request_.machine,
                                                            request_.feedrate, attendance.stop));
  }
  if (request_.files == Files::kNone) {
    return result;
  }
  is_partial_ = result.failure.has_value();
  remove_stale_results(request_.folder, result.failure ? Results::kPartial : Results::kWhole,
                       request_.trace);
  TWIN_CHECK(write_summary(request_.folder, result));
  return result;
}

Expected<void> Session::draw_figures(pictures::Paper paper) const {
  return session::draw_figures({request_.folder,
                                request_.program,
                                title(),
                                hal_ == nullptr ? TraceKind::kPlan : TraceKind::kRun,
                                trace_file().filename().string(),
                                {},
                                paper});
}

Expected<void> Session::write_report() const {
  const std::array<std::filesystem::path, 1> folders{request_.folder};
  const auto known = [this](const TraceOrigin&) { return std::optional(request_.program); };
  return session::write_report(folders, known, request_.folder / kReportName);
}

Expected<void> Session::render_video(const std::string& camera,
                                     std::function<void(double)> progress) const {
  return session::render_video({request_.folder, request_.machine.table.model, title(), camera,
                                std::move(progress), trace_file().filename().string()});
}

}  // namespace twin::session
