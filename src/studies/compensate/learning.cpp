#include "studies/compensate/learning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/units.hpp"
#include "runtime/correction_file.hpp"
#include "studies/compensate/model_run.hpp"

namespace twin::studies::compensate {
namespace {

constexpr double kBelowHum = 0.6;   // of the hum's frequency, up to which is learnt
constexpr double kShortest = 0.25;  // run that is learnt from [s]
constexpr std::size_t kRuns = 16;   // of the model, whose mean is compared with a run
constexpr std::string_view kFirst = "# twin learnt 1, runs = ";

/// A low-pass without delay: a sinc under a Hann window, with a gain of 1 at rest.
Filter low_pass(double cut_off, double period) {
  const double turns = cut_off * period;
  const auto half = static_cast<std::ptrdiff_t>(std::ceil(1.5 / turns));
  Filter filter;
  double sum = 0.0;
  for (std::ptrdiff_t m = -half; m <= half; ++m) {
    const double x = 2.0 * std::numbers::pi * turns * static_cast<double>(m);
    const double window = 0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(m) /
                                               static_cast<double>(half + 1));
    filter.taps.push_back(window * (m == 0 ? 1.0 : std::sin(x) / x));
    sum += filter.taps.back();
  }
  for (double& tap : filter.taps) {
    tap /= sum;
  }
  return filter;
}

std::string identified_advice(const config::MachineFile& machine) {
  return fmt::format(
      "the table of machine file {} was never identified (table.identified = false): identify it "
      "with twin identify TRACE.csv, whose machine file can be corrected with",
      machine.name);
}

/// Reads "a,b" of a line as micrometres.
bool read_pair(std::string_view line, Vec2& out) {
  std::array<double, 2> um{};
  const char* const end = line.data() + line.size();
  const auto [after, code] = std::from_chars(line.data(), end, um[0]);
  if (code != std::errc() || after == end || *after != ',') {
    return false;
  }
  const auto [rest, last] = std::from_chars(after + 1, end, um[1]);
  out = {units::mm_from_um(um[0]), units::mm_from_um(um[1])};
  return last == std::errc() && rest == end && out.allFinite();
}

}  // namespace

std::string MadeCorrection::remark() const {
  const results::ErrorStats& before = compensation.before;
  const results::ErrorStats& after = compensation.after;
  return fmt::format(
      "contour error of the model's table, mean over phases: max {:.2f} -> {:.2f} um, RMS {:.2f} "
      "-> "
      "{:.2f} um",
      units::um_from_mm(before.max), units::um_from_mm(after.max), units::um_from_mm(before.rms),
      units::um_from_mm(after.rms));
}

Expected<MadeCorrection> make_correction(const gcode::ProgramText& program,
                                         const config::MachineFile& machine,
                                         const std::optional<double>& feedrate,
                                         const CompensateOptions& options) {
  if (!machine.table.is_identified) {
    return fail(ErrorCode::kUsage, identified_advice(machine));
  }
  TWIN_TRY(const ContourPath path,
           ContourPath::plan(program, runtime::planned_with_reserve(machine), feedrate));
  if (!options.mismatch.empty() && options.mismatch.size() != path.points().size()) {
    return fail(ErrorCode::kFile,
                fmt::format("what was learnt is of {} periods, and the program has {}",
                            options.mismatch.size(), path.points().size()));
  }
  MadeCorrection made;
  TWIN_TRY(made.compensation, compensate(machine, path, options));
  made.correction.offsets = made.compensation.offsets;
  for (const motion::SetPoint& point : path.points()) {
    made.correction.points.push_back(point.position);
  }
  return made;
}

Expected<void> add_run(const config::MachineFile& machine, const ContourPath& path,
                       std::span<const Vec2> measured, std::span<const Vec2> offsets,
                       Learnt& learnt) {
  const std::size_t count = path.points().size();
  if (measured.size() != count || offsets.size() != count) {
    return fail(ErrorCode::kFile,
                fmt::format("the run has {} periods and its plan {}: nothing is learnt from it",
                            measured.size(), count));
  }
  if (static_cast<double>(count) * machine.period < kShortest) {
    return fail(ErrorCode::kFile,
                fmt::format("the run takes {:.3f} s, and {} s is the least to learn from",
                            static_cast<double>(count) * machine.period, kShortest));
  }
  const ModelRun model = mean_run(machine, path.points(), offsets, kRuns);
  learnt.mismatch.resize(count, Vec2::Zero());
  ++learnt.runs;
  const double weight = 2.0 / (learnt.runs + 1.0);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    const AxisResponse response =
        axis_response(machine, axis, machine.compensation.highest_frequency);
    const hal::mujoco::DriveParams& drive = machine.table.axis[axis].drive;
    const double hum = drive.hum_amplitude > 0.0 ? drive.hum_frequency_Hz : 0.0;
    std::vector<double> difference(count);
    for (std::size_t i = 0; i < count; ++i) {
      difference[i] = measured[i][k] - model.encoder[i][k];
    }
    const double cut_off = std::min(response.trusted, hum > 0.0 ? kBelowHum * hum : 1e9);
    const std::vector<double> smooth = low_pass(cut_off, machine.period).apply(difference);
    for (std::size_t i = 0; i < count; ++i) {
      learnt.mismatch[i][k] += weight * (smooth[i] - learnt.mismatch[i][k]);
    }
  }
  return {};
}

Expected<void> write_learnt(const std::filesystem::path& file, const Learnt& learnt) {
  std::string text = fmt::format("{}{}\nx_mismatch_um,y_mismatch_um\n", kFirst, learnt.runs);
  for (const Vec2& mismatch : learnt.mismatch) {
    text +=
        fmt::format("{},{}\n", units::um_from_mm(mismatch.x()), units::um_from_mm(mismatch.y()));
  }
  return write_whole_file(file, text);
}

Expected<Learnt> read_learnt(const std::filesystem::path& file, std::size_t periods) {
  Learnt learnt;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return learnt;
  }
  TWIN_TRY(const std::string text, read_whole_file(file));
  const auto refuse = [&](const std::string& why, int line) {
    return tl::unexpected(Error{ErrorCode::kFile, why, file.string(), line, 0});
  };
  std::string_view rest = text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (number == 1) {
      const std::string_view runs = line.substr(std::min(kFirst.size(), line.size()));
      const auto [after, code] =
          std::from_chars(runs.data(), runs.data() + runs.size(), learnt.runs);
      if (!line.starts_with(kFirst) || code != std::errc() || learnt.runs < 1) {
        return refuse(fmt::format("expected '{}N' in the first line", kFirst), number);
      }
    } else if (number > 2) {
      if (!read_pair(line, learnt.mismatch.emplace_back())) {
        return refuse(fmt::format("'{}': expected two numbers", line.substr(0, 60)), number);
      }
    }
  }
  if (learnt.mismatch.size() != periods) {
    return refuse(
        fmt::format("it is of {} periods, and the program has {}; remove the file to learn "
                    "anew",
                    learnt.mismatch.size(), periods),
        0);
  }
  return learnt;
}

}  // namespace twin::studies::compensate
