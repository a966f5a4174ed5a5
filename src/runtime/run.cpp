#include "runtime/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "config/settings.hpp"
#include "core/sha256.hpp"
#include "core/version.hpp"
#include "hal/active_machine.hpp"
#include "motion/safety/trip.hpp"
#include "runtime/cycle_time.hpp"
#include "runtime/feed_control.hpp"
#include "runtime/motion.hpp"
#include "runtime/motion_end.hpp"
#include "runtime/program_check.hpp"
#include "runtime/program_planner.hpp"
#include "runtime/realtime_thread.hpp"
#include "runtime/recorder.hpp"
#include "runtime/run_options.hpp"
#include "runtime/thrown.hpp"

namespace twin::runtime {
namespace {

constexpr std::size_t kSampleBuffer = 16384;
constexpr int kSamplesATurn = 1000;  // recorded between two looks at the user's wish to stop

/// One run: its threads and what they share.
class Run {
 public:
  /// @param planned_time  if it is known from planning beforehand [s]
  Run(const RunRequest& request, const ProgramFigures& program, Recorder&& recorder,
      std::optional<double> planned_time)
      : request_(request),
        program_(program),
        recorder_(std::move(recorder)),
        has_control_(request.is_wall_clock || !request.overrides.empty() ||
                     request.panel != nullptr),
        segments_(static_cast<std::size_t>(request.machine.path.look_ahead), room_for_next_plan()),
        samples_(kSampleBuffer),
        interpolator_(segments_, request.machine.period, request.machine.interpolation),
        cycle_(interpolator_, request.hal, request.machine.servo, request.machine.period,
               request.machine.safety, request.machine.limits.feedrate),
        feed_(interpolator_, segments_, link_,
              request.panel != nullptr ? *request.panel : own_panel_, feed_options(request)),
        planned_time_(planned_time) {}

  Expected<RunResult> execute();

 private:
  std::size_t room_for_next_plan() const {
    return has_control_ ? static_cast<std::size_t>(request_.machine.path.look_ahead) + 2 : 0;
  }
  void plan(gcode::Reader& reader);
  void guarded_plan(gcode::Reader& reader) noexcept;
  void move();
  void guarded_move() noexcept;
  void take(const results::Sample& sample);
  void flush();
  void record();
  void run_threads(gcode::Reader& reader);
  std::optional<Error> failure() const;
  void report_progress();
  results::Summary summarise(double wall_time);

  const RunRequest& request_;
  const ProgramFigures& program_;
  Recorder recorder_;
  bool has_control_;  // the path may be planned again while it is followed
  SegmentQueue segments_;
  SampleQueue samples_;
  motion::Interpolator interpolator_;
  Cycle cycle_;
  ReplanLink link_;
  OperatorPanel own_panel_;
  FeedControl feed_;
  std::optional<double> planned_time_;  // [s]
  std::atomic<bool> stop_{false};
  std::atomic<bool> has_ended_{false};
  PlanFigures plan_figures_;         // written by the planning thread, read after its end
  std::optional<Error> plan_error_;  // the same
  MotionResult motion_;              // written by the motion thread, read after its end
  std::optional<Error> move_error_;  // the same
  std::vector<std::string> notes_;   // the same
  std::optional<Error> record_error_;
  int shown_percent_ = -1;
};

void Run::plan(gcode::Reader& reader) {
  ProgramPlanner planner(reader, request_.machine, segments_, has_control_ ? &link_ : nullptr,
                         feed_.first_percent());
  planner.before_segment = request_.hooks.before_segment;
  if (auto figures = planner.run()) {
    plan_figures_ = *figures;
  } else {
    plan_error_ = figures.error();
    stop_ = true;
  }
}

/// Body of the planning thread: nothing escapes, and the motion thread is told the end.
void Run::guarded_plan(gcode::Reader& reader) noexcept {
  try {
    plan(reader);
  } catch (...) {
    plan_error_ = thrown("planning");
    stop_ = true;
  }
  if (plan_error_) {
    segments_.close(SegmentQueue::kEveryPlan);
  }
  link_.break_off();
}

void Run::move() {
  std::optional<RealtimeThread> realtime;
  if (request_.is_wall_clock) {
    realtime.emplace(request_.machine.realtime);
    notes_ = realtime->notes();
  }
  Pace pace = pace_of(request_);
  pace.feed = has_control_ ? &feed_ : nullptr;
  const Limits& limits = request_.machine.limits;
  motion_ = run_motion(cycle_, interpolator_, segments_, samples_, limits, pace, stop_);
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
  segments_.stop();
  feed_.show_end();
  has_ended_.store(true, std::memory_order_release);
}

/// Records a sample; after an error drops it, so that the machine can brake.
void Run::take(const results::Sample& sample) {
  if (record_error_) {
    return;
  }
  if (auto taken = recorder_.take(sample); !taken) {
    record_error_ = taken.error();
    stop_ = true;
  }
}

/// Hands the rows of this turn to the sinks.
void Run::flush() {
  if (record_error_) {
    return;
  }
  if (auto taken = recorder_.flush(); !taken) {
    record_error_ = taken.error();
    stop_ = true;
  }
}

/// Drains the samples until the motion has ended. Nothing escapes: what throws brakes the machine.
void Run::record() {
  results::Sample sample;
  for (;;) {
    const bool has_ended = has_ended_.load(std::memory_order_acquire);
    bool is_empty = true;
    try {
      for (int i = 0; i < kSamplesATurn && samples_.pop(sample); ++i) {
        is_empty = false;
        take(sample);
      }
      flush();
      if (request_.stop != nullptr && request_.stop->load()) {
        stop_ = true;
      }
      report_progress();
    } catch (...) {
      record_error_ = thrown("recording");
      stop_ = true;
    }
    if (is_empty && has_ended) {
      return;
    }
    if (is_empty) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }
}

void Run::report_progress() {
  if (!request_.progress || program_.lines == 0 || record_error_) {
    return;
  }
  const auto percent =
      static_cast<int>(100 * recorder_.last().line / std::max<std::int64_t>(program_.lines, 1));
  if (percent != shown_percent_) {
    shown_percent_ = percent;
    request_.progress(percent / 100.0);
  }
}

std::optional<Error> Run::failure() const {
  // What switched the machine off is said before what only braked it.
  const bool was_switched_off =
      motion_.trip && motion_.trip->reaction == motion::Reaction::kImmediate;
  for (const auto& error : {move_error_, record_error_, plan_error_}) {
    if (error && !was_switched_off) {
      return error;
    }
  }
  return describe_end(motion_, recorder_.last(), request_.hal);
}

results::Summary Run::summarise(double wall_time) {
  results::Summary summary;
  summary.program = request_.program.filename().string();
  summary.machine = request_.machine.name;
  summary.hal = request_.hal == nullptr ? "none" : request_.hal->info().name;
  summary.planner = kPlannerNames[static_cast<std::size_t>(request_.machine.path.planner)];
  summary.interpolator = kCurveNames[static_cast<std::size_t>(request_.machine.path.curves)];
  summary.simulated = request_.hal == nullptr || request_.hal->info().simulated;
  summary.period = request_.machine.period;
  put_into(summary, plan_figures_, request_.machine.path.planner == Planner::kCertified);
  summary.planned_time = planned_time_.value_or(plan_figures_.time);
  summary.overrides = feed_.records();
  summary.notes = request_.machine.notes;
  summary.version = version();
  summary.command = request_.command;
  summary.program_sha256 = sha256_of_file(request_.program);
  summary.settings = config::settings_of(request_.machine);
  recorder_.summarise(summary);
  if (summary.run) {
    summary.run->real_time_factor = summary.run->machining_time / wall_time;
    if (summary.run->realtime) {
      summary.run->realtime->late_periods = motion_.late_periods;
      summary.run->realtime->worst_latency = motion_.worst_latency;
      summary.run->realtime->notes = notes_;
    }
  }
  return summary;
}

/// Starts both threads and records until they have ended.
void Run::run_threads(gcode::Reader& reader) {
  const std::jthread planning([this, &reader] { guarded_plan(reader); });
  try {
    const std::jthread motion([this] { guarded_move(); });
    record();
  } catch (...) {  // no second thread could be had
    move_error_ = thrown("the motion thread");
    segments_.stop();
  }
}

Expected<RunResult> Run::execute() {
  auto reader = gcode::Reader::open(request_.program.string(), reader_options(request_));
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  const auto start = std::chrono::steady_clock::now();
  run_threads(*reader);
  const double wall_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RunResult result;
  result.failure = failure();
  result.trip = motion_.trip;
  result.met_at = motion_.met_at;
  result.rest_at = motion_.rest_at;
  result.summary = summarise(wall_time);
  if (const auto saved = result.failure ? Expected<void>{} : recorder_.commit(); !saved) {
    result.failure = saved.error();
  }
  if (result.failure) {
    recorder_.abandon();
  }
  return result;
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
  const gcode::ReaderOptions options = reader_options(request);
  auto program = check_program(request.program, options, request.machine.limits);
  if (!program) {
    return tl::unexpected(program.error());
  }
  std::optional<double> planned_time;
  if (request.hal != nullptr || !request.overrides.empty()) {
    const auto plan = estimate_plan(request.program, options, request.machine, request.stop);
    if (!plan) {
      return tl::unexpected(plan.error());
    }
    planned_time = plan->time;
    if (request.estimated) {
      request.estimated(plan->time);
    }
  }
  TWIN_CHECK(make_folders(request.directory));
  hal::ActiveMachine machine(request.hal);
  if (auto started = machine.start(request.machine.period); !started) {
    return tl::unexpected(started.error());
  }
  auto recorder = Recorder::create(recorder_options(request));
  if (!recorder) {
    return tl::unexpected(recorder.error());
  }
  Run run(request, *program, std::move(*recorder), planned_time);
  return run.execute();
}

}  // namespace twin::runtime
