#include "studies/identify/axis_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "studies/identify/quantum.hpp"

namespace twin::studies::identify {
namespace {

constexpr std::size_t kBeginRows = 11;  // over which velocity and acceleration are fitted
constexpr double kMovingWay = 0.05;     // within these rows, from which on it is a motion [mm]
constexpr double kSettling = 0.15;      // after a begin in motion [s]
constexpr int kRowsAtEnd = 2;           // whose differences reach beyond the record
constexpr double kMovingStep = 1e-3;    // of the set point in a row, from which on it moves [mm]
constexpr double kOffCount = 0.1;       // how far from a count an interpolated row is [counts]

/// Velocity and acceleration at the first row, by a parabola through the first rows.
std::optional<BeginOfMotion> begin_of(const AxisRecord& record, double period) {
  if (record.measured.size() < kBeginRows) {
    return {};
  }
  const auto& y = record.measured;
  const double way = std::abs(y[kBeginRows - 1] - y[0]);
  const double asked =
      std::abs(record.command[kBeginRows - 1].position - record.command[0].position);
  if (std::min(way, asked) < kMovingWay) {
    return {};
  }
  constexpr auto kHalf = static_cast<double>(kBeginRows / 2);
  double slope = 0.0;
  double bend = 0.0;
  double mean = 0.0;
  double squares = 0.0;
  double fourths = 0.0;
  for (std::size_t k = 0; k < kBeginRows; ++k) {
    const double t = static_cast<double>(k) - kHalf;
    mean += y[k] / static_cast<double>(kBeginRows);
    squares += t * t;
    fourths += t * t * t * t;
    slope += t * y[k];
  }
  const double mean_square = squares / static_cast<double>(kBeginRows);
  for (std::size_t k = 0; k < kBeginRows; ++k) {
    const double t = static_cast<double>(k) - kHalf;
    bend += (t * t - mean_square) * (y[k] - mean);
  }
  slope /= squares;
  bend /= fourths - squares * mean_square;
  BeginOfMotion begin;
  begin.command = record.command.front();
  begin.acceleration = 2.0 * bend / (period * period);
  begin.velocity = slope / period - begin.acceleration * kHalf * period;
  begin.position = mean - bend * mean_square - slope * kHalf + bend * kHalf * kHalf;
  begin.volts =
      record.has_volts() ? record.volts.front() : std::numeric_limits<double>::quiet_NaN();
  return begin;
}

/// Goes on with the motion at an end of a record, where differences across the end would take the
/// axis for at rest and give accelerations that no axis has.
/// @param from     row whose differences are within the record
/// @param towards  +1 or -1, towards the end
void go_on(std::vector<motion::Reference>& command, std::size_t from, int towards, double period) {
  for (int i = 1; i <= kRowsAtEnd; ++i) {
    motion::Reference& row =
        command[static_cast<std::size_t>(static_cast<int>(from) + i * towards)];
    row.acceleration = command[from].acceleration;
    row.velocity = command[from].velocity + row.acceleration * period * i * towards;
  }
}

/// Set points with velocity and acceleration; a record may begin and end in motion.
std::vector<motion::Reference> moving_command(const std::vector<double>& positions, double period) {
  std::vector<motion::Reference> command = differentiate(positions, period);
  const std::size_t rows = positions.size();
  if (rows < 3 * kRowsAtEnd) {
    return command;
  }
  if (std::abs(positions[1] - positions[0]) > kMovingStep) {
    go_on(command, kRowsAtEnd, -1, period);
  }
  if (std::abs(positions[rows - 1] - positions[rows - 2]) > kMovingStep) {
    go_on(command, rows - 1 - kRowsAtEnd, 1, period);
  }
  return command;
}

/// Rows that are between two counts.
std::vector<bool> interpolated_rows(const std::vector<double>& measured) {
  const auto quantum = quantum_of(measured);
  if (!quantum) {
    return {};
  }
  std::vector<bool> is_between(measured.size());
  std::size_t between = 0;
  double whole = measured.front();  // the last row that was on a count, so that no error adds up
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const double counts = (measured[k] - whole) / *quantum;
    is_between[k] = std::abs(counts - std::round(counts)) > kOffCount;
    between += is_between[k] ? 1 : 0;
    whole = is_between[k] ? whole : measured[k];
  }
  // Where it is most rows the first one was not on a count.
  const bool is_credible = between > 0 && between < measured.size() / 5;
  return is_credible ? is_between : std::vector<bool>();
}

}  // namespace

AxisRecord axis_record(const Recording& recording, hal::Axis axis,
                       const config::MachineFile& machine) {
  const AxisSignals& signals = recording.axis[axis];
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  AxisRecord record;
  record.trace = recording.file.string();
  record.command = moving_command(signals.command, recording.period);
  record.measured = signals.measured;
  record.volts = signals.volts;
  const double per_volt = signals.volts_in == Quantity::kSpeed ? params.mm_per_s_per_volt()
                          : signals.volts_in == Quantity::kRotationSpeed
                              ? params.drive.vref_scale_rpm_per_V
                              : 1.0;
  std::ranges::for_each(record.volts, [&](double& volts) { volts /= per_volt; });
  record.force = signals.force;
  double to_force =
      signals.force_in == Quantity::kTorque ? 1.0 / units::m_from_mm(params.mm_per_rad()) : 1.0;
  if (record.force.empty() && params.drive.mode == hal::mujoco::DriveMode::kTorque) {
    record.force = record.volts;
    to_force = params.torque_per_volt() / units::m_from_mm(params.mm_per_rad());
  }
  std::ranges::for_each(record.force, [&](double& force) { force *= to_force; });
  record.scale = signals.scale;
  record.is_at_table =
      recording.is_at_table || params.encoder.place == hal::mujoco::EncoderPlace::kTable;
  record.is_left_out = interpolated_rows(record.measured);
  record.begin = begin_of(record, recording.period);
  return record;
}

AxisRecord part_of(const AxisRecord& record, std::size_t first, std::size_t rows, double period) {
  const auto cut = [&](const auto& all) {
    using List = std::remove_cvref_t<decltype(all)>;
    if (all.empty()) {
      return List();
    }
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return List(begin, begin + static_cast<std::ptrdiff_t>(rows));
  };
  AxisRecord part{cut(record.command), cut(record.measured),    cut(record.volts),
                  cut(record.force),   cut(record.is_left_out), {},
                  record.trace,        cut(record.scale),       record.is_at_table};
  part.begin = first == 0 ? record.begin : begin_of(part, period);
  return part;
}

std::size_t trained_rows(const AxisRecord& record, double held_out_share) {
  return static_cast<std::size_t>((1.0 - held_out_share) *
                                  static_cast<double>(record.measured.size()));
}

std::size_t settling_rows(const AxisRecord& record, double period) {
  return record.begin ? std::min(static_cast<std::size_t>(std::lround(kSettling / period)),
                                 record.measured.size() / 4)
                      : 0;
}

AxisRun follow_record(const config::MachineFile& machine, hal::Axis axis,
                      const AxisRecord& record) {
  AxisSetup setup = axis_setup(machine, axis);
  setup.axis.travel = 1e4;
  setup.axis.encoder.place = place_of(record);
  return record.begin ? simulate_moving(setup, record.command, *record.begin)
                      : simulate(setup, record.command);
}

}  // namespace twin::studies::identify
