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
constexpr double kLeastAgreement = 0.97;    // correlation of the two
constexpr double kPart = 0.5;               // of a recording, in which they are compared [s]
constexpr double kTellingPart = 0.3;        // RMS of its drive command beside that of all
constexpr double kMostChange = 1.3;         // of force over drive command from part to part

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) {
    most = std::max(most, std::abs(value));
  }
  return most;
}

const char* name_of(hal::Axis axis) { return axis == hal::kX ? "x" : "y"; }

/// Sums of squares and products of drive command and force, both about 0.
struct Products {
  double volts = 0.0;
  double both = 0.0;
  double force = 0.0;
  double rows = 0.0;

  void add(double v, double f) {
    volts += v * v;
    both += v * f;
    force += f * f;
    rows += 1.0;
  }
  double slope() const { return both / std::max(volts, 1e-300); }
  double correlation() const { return both / std::max(std::sqrt(volts * force), 1e-300); }
  double mean_square() const { return volts / std::max(rows, 1.0); }
};

/// How the force goes with the drive command.
struct Agreement {
  Products all;
  double lowest = 0.0;   ///< slope of a part [N/V]
  double highest = 0.0;  ///< the same
};

Agreement agreement(std::span<const AxisRecord> records, double period) {
  const auto part = static_cast<std::size_t>(std::lround(kPart / period));
  Agreement result;
  std::vector<Products> parts;
  for (const AxisRecord& record : records) {
    for (std::size_t k = 0; k < record.force.size(); ++k) {
      if (k % part == 0) {
        parts.emplace_back();
      }
      parts.back().add(record.volts[k], record.force[k]);
      result.all.add(record.volts[k], record.force[k]);
    }
  }
  result.lowest = result.highest = result.all.slope();
  for (const Products& one : parts) {
    const bool tells = one.rows >= static_cast<double>(part) / 2.0 &&
                       one.mean_square() > kTellingPart * kTellingPart * result.all.mean_square();
    if (tells) {
      result.lowest = std::min(result.lowest, one.slope());
      result.highest = std::max(result.highest, one.slope());
    }
  }
  return result;
}

/// Whether the force goes with the drive command by one and the same scale.
bool is_steady(const Agreement& agreement) {
  const auto [least, most] = std::minmax({std::abs(agreement.lowest), std::abs(agreement.highest)});
  return agreement.all.correlation() >= kLeastAgreement &&
         agreement.lowest * agreement.highest > 0.0 && most <= kMostChange * least;
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
  const Agreement both = agreement(records, machine.period);
  const double scale = params.torque_per_volt() / units::m_from_mm(params.mm_per_rad());
  if (!is_steady(both)) {
    return fail(
        ErrorCode::kUsage,
        fmt::format(
            "the force of {0} and its drive command contradict each other: {1:.4g} N/V in "
            "some parts, {2:.4g} N/V in others (correlation {3:.2f}), the machine file says "
            "{4:.4g} N/V. Is one of the columns another axis' or another quantity?",
            name, both.lowest, both.highest, both.all.correlation(), scale));
  }
  if (std::abs(both.all.slope() / scale - 1.0) > kMostContradiction) {
    return fail(
        ErrorCode::kUsage,
        fmt::format("the force of {0} is {1:.4g} N/V of its drive command, the machine file "
                    "says {2:.4g} N/V: which is wrong?",
                    name, both.all.slope(), scale));
  }
  return {};
}

bool moves_enough(const AxisRecord& record) {
  const auto [low, high] = std::ranges::minmax_element(record.measured);
  return record.measured.size() > 100 && *high - *low > kLeastWay;
}

}  // namespace twin::studies::identify
