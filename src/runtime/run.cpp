#include "runtime/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

#include "config/loop_margins.hpp"
#include "config/machine_file.hpp"
#include "core/atomic_file.hpp"
#include "core/must_finish.hpp"
#include "core/this_program.hpp"
#include "core/units.hpp"
#include "hal/active_machine.hpp"
#include "runtime/program_check.hpp"
#include "runtime/realtime_thread.hpp"
#include "runtime/recorder.hpp"
#include "runtime/run_errors.hpp"
#include "runtime/run_options.hpp"
#include "runtime/run_planning.hpp"
#include "runtime/shared_blocks.hpp"

#include "gcode/start.hpp"

namespace twin::runtime {
namespace {

constexpr std::size_t kSampleBuffer = 16384;
constexpr int kSamplesATurn = 1000;  // recorded between two looks at the user's wish to stop

// Segments of a plan that a run follows without another one.
constexpr std::size_t kMostKept = 4096;

/// What is known of a run before it starts.
struct Outlook {
  ProgramFigures program;
  std::optional<PlanFigures> plan;
  std::deque<feedrate::PlannedSegment> segments;  // of the plan, if is_kept
  bool is_kept = false;                           // the run follows this plan
};

/// Whether the path may be planned again while it is followed.
bool has_control(const RunRequest& request) {
  return request.is_wall_clock || !request.overrides.empty() || request.panel != nullptr;
}

ProgramPlanner::Replans replans_of(const RunRequest& request) {
  return has_control(request) ? ProgramPlanner::Replans::kOnRequest
                              : ProgramPlanner::Replans::kNever;
}

std::unique_ptr<RunPlanning> make_planning(const RunRequest& request, ProgramPlanner& planner,
                                           std::atomic<bool>& stop) {
  if (request.is_wall_clock) {
    return std::make_unique<WallClockPlanning>(request, planner, stop);
  }
  return std::make_unique<LockstepPlanning>(request, planner, stop);
}

/// One run: its threads and what they share.
class Run {
 public:
  Run(const RunRequest& request, Outlook& outlook, SharedBlocks& blocks, Recorder&& recorder)
      : request_(request),
        outlook_(outlook),
        recorder_(std::move(recorder)),
        panel_(request.panel != nullptr ? *request.panel : own_panel_),
        first_percent_(first_override(request.overrides, panel_)),
        planner_(blocks.first(), request.machine, replans_of(request), first_percent_),
        planning_(make_planning(request, planner_, stop_)),
        samples_(kSampleBuffer, request.is_wall_clock ? SampleQueue::Waiting::kPoll
                                                      : SampleQueue::Waiting::kAwake),
        interpolator_(planning_->supply(), request.machine.period, request.machine.interpolation),
        cycle_(interpolator_, request.hal, request.machine.servo, request.machine.period,
               request.machine.safety, request.machine.limits, request.servo),
        feed_(interpolator_, planning_->supply(), planning_->replanning(), panel_,
              feed_options(request, first_percent_)) {
    cycle_.stand_at(gcode::start_of(request.program, reader_options(request)));
    if (outlook.is_kept) {
      planner_.preload(std::move(outlook.segments), *outlook.plan);
      blocks.drop_first();
    }
  }

  Expected<RunResult> execute();

 private:
  void move();
  void guarded_move() noexcept;
  void note(const Expected<void>& recorded);
  bool record_turn();
  void record();
  void run_threads();
  std::optional<Error> failure() const;
  void report_progress();
  results::Summary summarise(double wall_time, const std::optional<Error>& failure);
  void summarise_early_end(results::Summary& summary, const Error& failure);

  const RunRequest& request_;
  const Outlook& outlook_;
  Recorder recorder_;
  OperatorPanel own_panel_;
  OperatorPanel& panel_;
  double first_percent_;  // override of the first plan [%]
  std::atomic<bool> stop_{false};
  ProgramPlanner planner_;
  std::unique_ptr<RunPlanning> planning_;
  SampleQueue samples_;
  motion::Interpolator interpolator_;
  Cycle cycle_;
  FeedControl feed_;
  MotionResult motion_;              // written by the motion thread, read after its end
  std::optional<Error> move_error_;  // the same
  std::vector<std::string> notes_;   // the same
  std::optional<Error> plan_error_;
  std::optional<Error> record_error_;
  int shown_percent_ = -1;
};

void Run::move() {
  std::optional<RealtimeThread> realtime;
  if (request_.is_wall_clock) {
    realtime.emplace(request_.machine.realtime);
    notes_ = realtime->notes();
  }
  MotionOptions options = motion_options(request_);
  options.feed = has_control(request_) ? &feed_ : nullptr;
  const auto pace = planning_->make_pace();
  motion_ = run_motion(cycle_, interpolator_, planning_->supply(), samples_, *pace, options, stop_);
}

/// Body of the motion thread: at its end the machine is off.
void Run::guarded_move() noexcept {
  try {
    move();
  } catch (...) {
    cycle_.switch_off();
    motion_.end = MotionEnd::kMachineError;
    move_error_ = thrown("the motion thread");
  }
  planning_->stop();
  feed_.show_end();
  samples_.close();
}

/// After an error of the recorder the machine brakes.
void Run::note(const Expected<void>& recorded) {
  if (!recorded) {
    record_error_ = recorded.error();
    stop_ = true;
  }
}

/// Records the samples that wait, up to a number; after an error drops them, so that the machine
/// can brake. @returns whether there were any
bool Run::record_turn() {
  results::Sample sample;
  bool is_empty = true;
  for (int i = 0; i < kSamplesATurn && samples_.pop(sample); ++i) {
    is_empty = false;
    if (!record_error_) {
      note(recorder_.record(sample));
    }
  }
  samples_.show_room();
  if (!record_error_) {
    note(recorder_.flush());
  }
  if (request_.stop != nullptr && request_.stop->load()) {
    stop_ = true;
  }
  report_progress();
  return !is_empty;
}

/// Records until the motion has ended. Nothing escapes: what throws brakes the machine.
void Run::record() {
  for (bool goes_on = true; goes_on;) {
    try {
      goes_on = record_turn() || samples_.wait_for_samples();
    } catch (...) {
      record_error_ = thrown("recording");
      stop_ = true;
    }
  }
}

void Run::report_progress() {
  if (!request_.progress || outlook_.program.lines == 0 || record_error_) {
    return;
  }
  const auto percent = static_cast<int>(100 * recorder_.last().line / outlook_.program.lines);
  if (percent != shown_percent_) {
    shown_percent_ = percent;
    request_.progress(percent / 100.0);
  }
}

std::optional<Error> Run::failure() const {
  // What switched the machine off is said before what only braked it.
  const bool was_switched_off = motion_.trip && is_immediate(*motion_.trip);
  for (const auto& error : {move_error_, record_error_, plan_error_}) {
    if (error && !was_switched_off) {
      return error;
    }
  }
  const bool has_own_servo = request_.servo != nullptr;
  return describe_end(motion_, recorder_.last(), request_.hal,
                      motion_.trip && !has_own_servo
                          ? advice_on_loop(*motion_.trip, request_.machine)
                          : std::string());
}

/// What was done where the run has ended early.
void Run::summarise_early_end(results::Summary& summary, const Error& failure) {
  summary.early_end = results::EarlyEnd{failure.message, std::nullopt};
  summary.path_length = recorder_.path_length();
  if (recorder_.samples() > 0) {
    const results::Sample& last = recorder_.last();
    summary.early_end->at = results::Place{last.t, last.command, last.line, last.segment};
  }
}

results::Summary Run::summarise(double wall_time, const std::optional<Error>& failure) {
  const config::MachineFile& machine = request_.machine;
  const PlanFigures figures = planner_.figures();
  results::Summary summary;
  summary.program = request_.program.file().filename().string();
  summary.machine = machine.name;
  summary.hal = request_.hal == nullptr ? "none" : request_.hal->info().name;
  summary.planner = kPlannerNames[static_cast<std::size_t>(machine.path.planner)];
  summary.interpolator = kCurveNames[static_cast<std::size_t>(machine.path.curves)];
  summary.simulated = request_.hal == nullptr || request_.hal->info().simulated;
  summary.period = machine.period;
  put_into(summary, figures, machine.path.planner);
  summary.planned_time = outlook_.plan ? outlook_.plan->time : figures.time;
  summary.overrides = feed_.records();
  summary.notes = machine.notes;
  summary.version = version();
  summary.command = request_.command;
  summary.program_sha256 = request_.program.sha256();
  for (const gcode::ProgramText& text : request_.program.subprograms()) {
    summary.subprograms.emplace_back(text.file().filename().string(), text.sha256());
  }
  if (request_.program.has_changed()) {
    summary.notes.push_back(
        fmt::format("{} has changed since it was read; this run is of the program as it was then",
                    summary.program));
  }
  if (figures.blocks > 0 && figures.path_length == 0.0) {
    summary.notes.push_back(fmt::format(
        "nothing moves: all {} blocks of {} are far shorter than the tolerance and lead "
        "back to its start",
        figures.blocks, summary.program));
  }
  if (const double largest = recorder_.largest_feedrate(); largest > machine.limits.feedrate) {
    summary.notes.push_back(fmt::format("F{:g} mm/min is cut to limits.feedrate_mm_per_min, {:g}",
                                        units::mm_per_min_from_mm_per_s(largest),
                                        units::mm_per_min_from_mm_per_s(machine.limits.feedrate)));
  }
  summary.settings = config::settings_of(machine);
  recorder_.summarise(summary);
  if (failure) {
    summarise_early_end(summary, *failure);
  }
  if (summary.run) {
    if (request_.servo == nullptr && !request_.hal->info().follows_reference) {
      summary.loops.emplace();
      for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
        const config::LoopMargins loop =
            config::loop_margins(machine.servo[i], machine.table.axis[i], machine.period);
        (*summary.loops)[i] = {loop.bandwidth_Hz, loop.phase_margin_deg, loop.gain_margin};
      }
    }
    summary.run->real_time_factor = summary.run->machining_time / wall_time;
    if (summary.run->realtime) {
      summary.run->realtime->late_periods = motion_.late_periods;
      summary.run->realtime->worst_latency = motion_.worst_latency;
      summary.run->realtime->notes = notes_;
    }
  }
  return summary;
}

/// Starts the threads and records until they have ended.
void Run::run_threads() {
  try {
    planning_->start();
    const std::jthread motion([this] { guarded_move(); });
    record();
  } catch (...) {  // a thread could not be had
    move_error_ = thrown("starting a thread");
    planning_->stop();
  }
  plan_error_ = planning_->join();
}

Expected<RunResult> Run::execute() {
  const MustFinish finish;  // brakes on the path when it is to stop, and keeps what was recorded
  const auto start = std::chrono::steady_clock::now();
  run_threads();
  const double wall_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RunResult result;
  result.failure = failure();
  result.trip = motion_.trip;
  result.met_at = motion_.met_at;
  result.rest_at = motion_.rest_at;
  result.summary = summarise(wall_time, result.failure);
  recorder_.describe(result.summary);
  if (!result.failure) {
    if (auto saved = recorder_.commit(); !saved) {
      result.failure = std::move(saved).error();
    }
  }
  if (result.failure) {
    recorder_.abandon();
  }
  return result;
}

void tell_notes(const RunRequest& request, const ProgramFigures& program) {
  if (request.noted && !program.notes.empty()) {
    request.noted(program.notes);
  }
}

/// Reads the whole program before anything moves, and plans it where the plan is of use: where
/// nothing can change it on the way and it is not too long, the run follows it, so it is made once;
/// where an operator or a schedule may change it, for the machining time.
Expected<Outlook> look_at(const RunRequest& request) {
  const gcode::ReaderOptions options = reader_options(request);
  if (request.hal == nullptr && request.overrides.empty()) {
    TWIN_TRY(const ProgramFigures program,
             check_program(request.program, options, request.machine.limits, request.stop));
    tell_notes(request, program);
    return Outlook{.program = program, .plan = std::nullopt, .segments = {}};
  }
  Outlook outlook{.program = {}, .plan = std::nullopt, .segments = {}};
  const bool keeps = !has_control(request);
  TWIN_TRY(const Estimate estimate,
           estimate_program(request.program, options, request.machine, request.stop,
                            [&outlook, keeps](feedrate::PlannedSegment&& planned) {
                              if (keeps) {
                                outlook.segments.push_back(std::move(planned));
                              }
                              return outlook.segments.size() <= kMostKept;
                            }));
  outlook.program = estimate.program;
  tell_notes(request, estimate.program);
  outlook.is_kept = keeps && estimate.is_whole;
  if (!estimate.is_whole) {
    outlook.segments.clear();
    return outlook;
  }
  outlook.plan = estimate.plan;
  if (request.estimated) {
    request.estimated(estimate.plan.time);
  }
  return outlook;
}

/// Makes the folder of the results, and that of the plots in it.
Expected<void> make_folders(const std::filesystem::path& directory) {
  std::error_code code;
  if (!directory.empty()) {
    std::filesystem::create_directories(directory / "plots", code);
  }
  return code ? file_error(directory, "make this folder", code.value()) : Expected<void>{};
}

}  // namespace

Expected<RunResult> run_program(const RunRequest& request) {
  TWIN_TRY(Outlook outlook, look_at(request));
  TWIN_CHECK(make_folders(request.directory));
  hal::ActiveMachine machine(request.hal);
  TWIN_CHECK(machine.start(request.machine.period));
  SharedBlocks blocks(gcode::Reader(request.program, reader_options(request)));
  TWIN_TRY(Recorder recorder, Recorder::create(recorder_options(request), blocks.second()));
  Run run(request, outlook, blocks, std::move(recorder));
  return run.execute();
}

}  // namespace twin::runtime
