#include "runtime/run_options.hpp"

#include <system_error>

#include "core/atomic_file.hpp"

namespace twin::runtime {
namespace {

/// What an HDF5 trace says of its run.
results::TraceOriginTexts origin_of(const RunRequest& request) {
  if (!results::has_hdf5(request.trace)) {
    return {};
  }
  return {.program = request.program.file().filename().string(),
          .program_sha256 = request.program.sha256(),
          .settings = config::to_toml(request.machine)};
}

constexpr double kRestAfter = 0.1;  // at the path's end, before the machine is switched off [s]

}  // namespace

gcode::ReaderOptions reader_options(const config::MachineFile& machine,
                                    const std::optional<double>& feedrate) {
  const ProgramSettings& program = machine.program;
  gcode::ReaderOptions options;
  options.feedrate = feedrate;
  options.block_delete = program.skips_deleted;
  options.dialect = program.dialect;
  for (const char letter : program.ignored_axes) {
    options.ignored_axes.push_back(letter >= 'a' ? static_cast<char>(letter - 'a' + 'A') : letter);
  }
  options.workpiece = program.workpiece;
  options.tool_table = program.tool_table;
  options.default_feedrate = program.default_feedrate;
  options.parameters = program.parameters;
  options.start = program.start;
  options.lifts_start = program.lifts_start;
  options.largest_feedrate = machine.limits.feedrate;
  options.most_lines = program.most_lines;
  return options;
}

gcode::ReaderOptions reader_options(const RunRequest& request) {
  gcode::ReaderOptions options = reader_options(request.machine, request.feedrate);
  options.may_probe = request.hal == nullptr || request.hal->info().simulated;
  return options;
}

FeedControl::Options feed_options(const RunRequest& request, double first_percent) {
  const Limits& limits = request.machine.limits;
  return {.schedule = request.overrides,
          .ramp = {.acceleration = limits.acceleration, .jerk = limits.jerk},
          .period = request.machine.period,
          .is_wall_clock = request.is_wall_clock,
          .first_percent = first_percent,
          .feedrate = limits.feedrate};
}

MotionOptions motion_options(const RunRequest& request) {
  return {.period = request.machine.period,
          .rest_after = kRestAfter,
          .ready_timeout = request.machine.safety.ready_timeout,
          .limits = request.machine.limits,
          .until = request.until};
}

WallClockPace::Options wall_clock_options(const RunRequest& request) {
  const bool keeps_own_time = request.hal != nullptr && request.hal->info().keeps_own_time;
  return {.period = request.machine.period,
          .realtime = request.machine.realtime,
          .schedule = keeps_own_time ? Schedule::kKept : Schedule::kShifted,
          .before_period = request.hooks.before_period};
}

Recorder::Options recorder_options(const RunRequest& request) {
  return {.directory = request.directory,
          .trace = request.trace,
          .origin = origin_of(request),
          .sinks = request.sinks,
          .columns = request.columns,
          .limits = request.machine.limits,
          .period = request.machine.period,
          .has_machine = request.hal != nullptr,
          .is_wall_clock = request.is_wall_clock,
          .durability = request.durability};
}

Expected<void> make_folders(const std::filesystem::path& directory) {
  std::error_code code;
  if (!directory.empty()) {
    std::filesystem::create_directories(directory / "plots", code);
  }
  return code ? file_error(directory, "make this folder", code.value()) : Expected<void>{};
}

}  // namespace twin::runtime
