#include "studies/identify/signal_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kMostCommand = 9.0;        // of a speed command, by the V-REF scale [V]
constexpr double kPeakCommand = 6.0;        // that the scale makes of its peak [V]
constexpr double kLeastWay = 1.0;           // of a record that is validated [mm]
constexpr double kMostContradiction = 0.1;  // of force over that of the drive command, from 1
constexpr double kLeastAgreement = 0.9;     // correlation of the two

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) {
    most = std::max(most, std::abs(value));
  }
  return most;
}

const char* name_of(hal::Axis axis) { return axis == hal::kX ? "x" : "y"; }

/// Slope and correlation of b over a, both about 0.
struct Agreement {
  double slope = 0.0;
  double correlation = 0.0;
};

Agreement agreement(std::span<const AxisRecord> records) {
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
  for (const AxisRecord& record : records) {
    for (std::size_t k = 0; k < record.force.size(); ++k) {
      aa += record.volts[k] * record.volts[k];
      ab += record.volts[k] * record.force[k];
      bb += record.force[k] * record.force[k];
    }
  }
  return {ab / std::max(aa, 1e-300), ab / std::max(std::sqrt(aa * bb), 1e-300)};
}

}  // namespace

Expected<void> fit_units(const std::vector<Recording>& recordings, hal::Axis axis,
                         Identification& result) {
  hal::mujoco::AxisParams& params = result.machine.table.axis[axis];
  double peak = 0.0;  // of a speed command [rpm]
  for (const Recording& recording : recordings) {
    const AxisSignals& signals = recording.axis[axis];
    if (signals.volts_in == Quantity::kSpeed) {
      peak = std::max(peak, largest(signals.volts) / params.screw.lead * 60.0);
    } else if (signals.volts_in == Quantity::kRotationSpeed) {
      peak = std::max(peak, largest(signals.volts));
    }
  }
  if (peak > kMostCommand * std::abs(params.drive.vref_scale_rpm_per_V)) {
    params.drive.vref_scale_rpm_per_V =
        std::copysign(std::round(peak / kPeakCommand), params.drive.vref_scale_rpm_per_V);
    result.notes.push_back(fmt::format(
        "{}: the speed command reaches {:.0f} rpm; its V-REF scale begins at {:.0f} rpm/V",
        axis == hal::kX ? "X" : "Y", peak, params.drive.vref_scale_rpm_per_V));
  }
  return {};
}

Expected<void> check_signals(std::span<const AxisRecord> records, hal::Axis axis,
                             const config::MachineFile& machine) {
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  if (params.drive.mode != hal::mujoco::DriveMode::kTorque || records.empty()) {
    return {};
  }
  const char* const name = name_of(axis);
  if (!records.front().has_volts()) {
    return fail(ErrorCode::kUsage,
                fmt::format("table.{0}.drive_mode = \"torque\" needs drive commands, "
                            "--columns {0}_V=COLUMN",
                            name));
  }
  if (params.torque_per_volt() == 0.0) {
    return fail(ErrorCode::kUsage,
                fmt::format("table.{0}.drive_mode = \"torque\" needs a scale: --set "
                            "table.{0}.force_scale_N_per_V=... or table.{0}.torque_scale_N_m_per_V",
                            name));
  }
  const Agreement both = agreement(records);
  const double scale = params.torque_per_volt() / units::m_from_mm(params.mm_per_rad());
  if (both.correlation < kLeastAgreement ||
      std::abs(both.slope / scale - 1.0) > kMostContradiction) {
    return fail(ErrorCode::kUsage,
                fmt::format("the force of {0} is {1:.4g} N/V of its drive command (correlation "
                            "{2:.2f}), the machine file says {3:.4g} N/V: which is wrong?",
                            name, both.slope, both.correlation, scale));
  }
  return {};
}

bool moves_enough(const AxisRecord& record) {
  const auto [low, high] = std::ranges::minmax_element(record.measured);
  return record.measured.size() > 100 && *high - *low > kLeastWay;
}

}  // namespace twin::studies::identify
