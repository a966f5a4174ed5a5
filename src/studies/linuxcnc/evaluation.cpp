#include "studies/linuxcnc/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/must_finish.hpp"
#include "core/this_program.hpp"
#include "gcode/reader.hpp"
#include "results/trace/columns.hpp"
#include "results/trace/trace_files.hpp"
#include "results/trace/trace_reader.hpp"
#include "runtime/recorder.hpp"
#include "runtime/run_options.hpp"
#include "runtime/shared_blocks.hpp"
#include "session/results.hpp"
#include "studies/linuxcnc/place_finder.hpp"

namespace twin::studies::linuxcnc {
namespace {

constexpr double kStands = 1e-9;     // a set point that moves less has not moved [mm]
constexpr double kFollows = 1.0;     // farthest that a set point may be from the program [mm]
constexpr double kDone = 1.0;        // of the program's length that may be left out [mm]
constexpr std::size_t kCommand = 2;  // place of x_cmd_mm in kRead

constexpr std::array<std::string_view, 16> kRead{
    "t_s",         "line",         "x_cmd_mm",     "y_cmd_mm",         "z_cmd_mm",  "x_enc_mm",
    "y_enc_mm",    "x_table_mm",   "y_table_mm",   "x_drive_V",        "y_drive_V", "x_torque_Nm",
    "y_torque_Nm", "x_friction_N", "y_friction_N", "feedrate_mm_per_s"};

Vec3 command_of(std::span<const double> row) {
  return {row[kCommand], row[kCommand + 1], row[kCommand + 2]};
}

results::Sample sample_of_row(std::span<const double> row) {
  results::Sample sample;
  sample.line = std::llround(row[1]);
  sample.command = command_of(row);
  sample.encoder = {row[5], row[6]};
  sample.table = {row[7], row[8]};
  sample.volts = {row[9], row[10]};
  sample.torque = {row[11], row[12]};
  sample.friction = {row[13], row[14]};
  sample.feedrate = row[15];
  return sample;
}

/// Rows of a recording during which the set point moves, and one at either end.
struct Motion {
  std::int64_t first = 0;
  std::int64_t last = 0;
  bool is_any = false;
};

Expected<Motion> find_motion(const std::filesystem::path& file) {
  Motion motion;
  std::int64_t row = 0;
  std::optional<Vec3> before;
  TWIN_CHECK(results::read_rows(file, kRead, [&](std::span<const double> values) {
    const Vec3 command = command_of(values);
    if (before && (command - *before).norm() > kStands) {
      motion.first = motion.is_any ? motion.first : row - 1;
      motion.is_any = true;
      motion.last = row;
    }
    before = command;
    ++row;
  }));
  return motion;
}

runtime::BlockSource blocks_of(const EvaluationRequest& request,
                               std::optional<gcode::Reader>& reader) {
  reader.emplace(request.program, runtime::reader_options(request.machine, std::nullopt));
  return [&reader] { return reader->next(); };
}

results::Summary begin_summary(const EvaluationRequest& request) {
  results::Summary summary;
  summary.program = request.program.file().filename().string();
  summary.machine = request.machine.name;
  summary.hal = "linuxcnc";
  summary.planner = "linuxcnc";
  summary.interpolator = "linuxcnc";
  summary.period = request.machine.period;
  summary.version = version();
  summary.command = request.command;
  summary.program_sha256 = request.program.sha256();
  summary.settings = config::settings_of(request.machine);
  return summary;
}

/// A recording on its way through the recorder of runs.
class Evaluation {
 public:
  Evaluation(const EvaluationRequest& request, runtime::Recorder& recorder, PlaceFinder& places)
      : period_(request.machine.period), recorder_(recorder), places_(places) {}

  Expected<void> take(std::span<const double> row) {
    results::Sample sample = sample_of_row(row);
    TWIN_TRY(sample.block, places_.find(sample.command));
    sample.segment = sample.block;
    sample.t = static_cast<double>(rows_++) * period_;
    return recorder_.record(sample);
  }

 private:
  double period_;
  runtime::Recorder& recorder_;
  PlaceFinder& places_;
  std::int64_t rows_ = 0;
};

Expected<void> take_rows(const std::filesystem::path& file, const Motion& motion,
                         Evaluation& evaluation) {
  TWIN_TRY(results::TraceReader reader, results::TraceReader::open(file));
  TWIN_CHECK(reader.select(kRead));
  std::array<double, kRead.size()> values{};
  for (std::int64_t row = 0; row <= motion.last; ++row) {
    TWIN_TRY(const bool has_row, reader.next(values));
    if (has_row && row >= motion.first) {
      TWIN_CHECK(evaluation.take(values));
    }
  }
  return {};
}

/// Length of all blocks [mm].
Expected<double> program_length(const EvaluationRequest& request) {
  std::optional<gcode::Reader> reader;
  const runtime::BlockSource blocks = blocks_of(request, reader);
  double length = 0.0;
  for (;;) {
    TWIN_TRY(const std::optional<gcode::Block> block, blocks());
    if (!block) {
      return length;
    }
    length += results::block_length(*block, results::View::kSpace);
  }
}

Expected<void> check_followed(const EvaluationRequest& request, const PlaceFinder& places) {
  const std::string program = request.program.file().filename().string();
  if (places.largest_distance() > kFollows) {
    return tl::unexpected(
        Error{ErrorCode::kFile,
              fmt::format("is not a recording of {}: a set point is {:.3f} mm away from it",
                          program, places.largest_distance()),
              (request.folder / results::kTraceName).string(), 0, 0});
  }
  TWIN_TRY(const double length, program_length(request));
  if (places.place() < length - kDone) {
    return tl::unexpected(
        Error{ErrorCode::kFile,
              fmt::format("ends at {:.1f} of the {:.1f} mm of {}: LinuxCNC has not come to its end",
                          places.place(), length, program),
              (request.folder / results::kTraceName).string(), 0, 0});
  }
  return {};
}

}  // namespace

Expected<results::Summary> evaluate(const EvaluationRequest& request) {
  const MustFinish finish;
  const std::filesystem::path file = request.folder / results::kTraceName;
  TWIN_TRY(const Motion motion, find_motion(file));
  if (!motion.is_any) {
    return tl::unexpected(
        Error{ErrorCode::kFile, "nothing moves in this recording", file.string(), 0, 0});
  }
  TWIN_CHECK(session::prepare_output_file(request.folder / "plots" / results::kLimitName));
  std::optional<gcode::Reader> for_places;
  std::optional<gcode::Reader> for_errors;
  PlaceFinder places(blocks_of(request, for_places));
  runtime::Recorder::Options options;
  options.directory = request.folder;
  options.columns =
      *results::choose_columns("default,path_mm,x_torque_Nm,y_torque_Nm,x_friction_N,y_friction_N",
                               results::Layout::kRun, true);
  options.limits = request.machine.limits;
  options.period = request.machine.period;
  options.durability = Durability::kCached;
  TWIN_TRY(runtime::Recorder recorder,
           runtime::Recorder::create(options, blocks_of(request, for_errors)));
  Evaluation evaluation(request, recorder, places);
  TWIN_CHECK(take_rows(file, motion, evaluation));
  TWIN_CHECK(check_followed(request, places));
  results::Summary summary = begin_summary(request);
  summary.path_length = recorder.path_length();
  recorder.summarise(summary);
  TWIN_CHECK(recorder.commit());
  TWIN_CHECK(write_whole_file(request.folder / "summary.json", results::to_json(summary)));
  return summary;
}

}  // namespace twin::studies::linuxcnc
