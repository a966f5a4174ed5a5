#include "studies/identify/recording_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twin::studies::identify {
namespace {

constexpr double kLeastMotion = 0.02;     // an axis that moves less stands still [mm]
constexpr double kSmallMotion = 1.0;      // a whole program of less may be in metres [mm]
constexpr double kFastShare = 20.0;       // of the machine's limit, which no true command exceeds
constexpr double kLeastLikeness = 0.9;    // correlation of command and measured
constexpr double kMostScaleError = 0.05;  // of measured against command
constexpr double kMostVolts = 15.0;       // beyond the converter's range [V]
constexpr std::size_t kStuckRows = 50;    // with the same count while the command goes on
constexpr double kStuckWay = 0.5;         // way of the command meanwhile that no axis stands [mm]
constexpr double kRougher = 5.0;          // than measured, a command seems to be the wrong one

struct Likeness {
  double correlation = 0.0;
  double slope = 0.0;  // of measured over command
};

Likeness likeness(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double mean_a = 0.0;
  double mean_b = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    mean_a += a[k] / n;
    mean_b += b[k] / n;
  }
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    aa += (a[k] - mean_a) * (a[k] - mean_a);
    ab += (a[k] - mean_a) * (b[k] - mean_b);
    bb += (b[k] - mean_b) * (b[k] - mean_b);
  }
  return {aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0, aa > 0.0 ? ab / aa : 0.0};
}

double range(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  return *high - *low;
}

double peak_velocity(const std::vector<double>& positions, double period) {
  double peak = 0.0;
  for (std::size_t k = 1; k < positions.size(); ++k) {
    peak = std::max(peak, std::abs(positions[k] - positions[k - 1]) / period);
  }
  return peak;
}

/// RMS second difference [mm].
double roughness(const std::vector<double>& positions) {
  double sum = 0.0;
  for (std::size_t k = 2; k < positions.size(); ++k) {
    const double second = positions[k] - 2.0 * positions[k - 1] + positions[k - 2];
    sum += second * second;
  }
  return std::sqrt(sum / static_cast<double>(positions.size()));
}

/// Name of the unit of a length that is nearest. @param to_base  [mm]
std::string_view length_unit(double to_base) {
  return to_base > 30.0 ? "m" : to_base > 0.03 ? "mm" : "um";
}

/// The checks of one axis, with the names of its columns for the messages.
struct AxisCheck {
  const Recording& recording;
  const AxisSignals& signals;
  const Column* columns;  // command, measured, volts
  std::size_t first;      // signal of the command

  tl::unexpected<Error> refuse(std::string message) const {
    return about(recording.file, std::move(message));
  }

  Expected<void> units(const Limits& limits) const {
    const double fastest = peak_velocity(signals.command, recording.period);
    if (fastest > kFastShare * limits.feedrate) {
      return refuse(
          fmt::format("column {} moves at up to {:.4g} mm/s, {:.0f} times the machine's "
                      "largest feedrate: is it in um ({}:um), or the time in ms?",
                      columns[0].name, fastest, fastest / limits.feedrate, columns[0].name));
    }
    const double slope = likeness(signals.command, signals.measured).slope;
    for (const double factor : {1000.0, -1000.0, 0.001, -0.001}) {
      if (std::abs(slope / factor - 1.0) < 0.3) {
        return refuse(
            fmt::format("column {0} moves {1:.4g} times as far as column {2}: their units differ; "
                        "is {0} in {4}, or {2} in {6}? then say --columns {3}={0}:{4} or "
                        "{5}={2}:{6}",
                        columns[1].name, slope, columns[0].name, kSignalNames[first + 1],
                        length_unit(columns[1].to_base / std::abs(factor)), kSignalNames[first],
                        length_unit(columns[0].to_base * std::abs(factor))));
      }
    }
    return {};
  }

  Expected<void> same_signal() const {
    const Likeness like = likeness(signals.command, signals.measured);
    if (std::abs(like.correlation) < kLeastLikeness) {
      return refuse(
          fmt::format("column {} does not follow column {} (correlation {:.2f}): is it "
                      "the measured position of that axis?",
                      columns[1].name, columns[0].name, like.correlation));
    }
    if (std::abs(like.slope - 1.0) > kMostScaleError) {
      return refuse(fmt::format(
          "column {} moves {:.3g} times as far as column {}{}", columns[1].name, like.slope,
          columns[0].name,
          like.slope < 0.0 ? ": its sign is turned round" : ": are both in the same unit?"));
    }
    return {};
  }

  Expected<void> volts() const {
    if (signals.volts.empty()) {
      return {};
    }
    const double most = std::max(std::abs(*std::ranges::min_element(signals.volts)),
                                 std::abs(*std::ranges::max_element(signals.volts)));
    if (columns[2].quantity == Quantity::kVoltage && most > kMostVolts) {
      return refuse(fmt::format("column {} reaches {:.4g} V: is it in mV ({}:mV)?", columns[2].name,
                                most, columns[2].name));
    }
    if (!(range(signals.volts) > 0.0)) {
      return refuse(fmt::format("column {} never changes, though the axis moves", columns[2].name));
    }
    return {};
  }

  Expected<void> force() const {
    if (!signals.force.empty() && !(range(signals.force) > 0.0)) {
      return refuse(fmt::format("column {} never changes, though the axis moves",
                                columns[signals.force_in == Quantity::kForce ? 3 : 4].name));
    }
    return {};
  }

  /// A scale on the table goes where the encoder goes.
  Expected<void> scale() const {
    if (signals.scale.empty()) {
      return {};
    }
    const Likeness like = likeness(signals.measured, signals.scale);
    if (std::abs(like.correlation) < kLeastLikeness ||
        std::abs(like.slope - 1.0) > kMostScaleError) {
      return refuse(fmt::format(
          "column {} is the table's position, but moves {:.4g} times as far as column {} "
          "(correlation {:.2f}): is it the same axis, in this unit and direction?",
          columns[5].name, like.slope, columns[1].name, like.correlation));
    }
    return {};
  }

  /// A counter that stands at its end while the command goes on.
  Expected<void> saturation() const {
    std::size_t since = 0;
    for (std::size_t k = 1; k < signals.measured.size(); ++k) {
      if (signals.measured[k] != signals.measured[since]) {
        since = k;
      }
      const double way = std::abs(signals.command[k] - signals.command[since]);
      if (k - since >= kStuckRows && way > std::max(kStuckWay, 0.02 * range(signals.command))) {
        return about(
            recording.file,
            fmt::format("column {} stands at {:g} mm for {} rows, while column {} goes on "
                        "by {:.3g} mm: a counter at its end, or a lost signal?",
                        columns[1].name, signals.measured[k], k - since, columns[0].name, way),
            static_cast<int>(recording.first_row + since) + 2);
      }
    }
    return {};
  }
};

}  // namespace

tl::unexpected<Error> about(const std::filesystem::path& file, std::string message, int line) {
  return tl::unexpected<Error>(Error{ErrorCode::kFile, std::move(message), file.string(), line, 0});
}

Expected<void> check_recording(Recording& recording, const ColumnMap& columns,
                               const Limits& limits) {
  double farthest = 0.0;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const AxisSignals& signals = recording.axis[axis];
    const Column* const names = &columns[axis == hal::kX ? kXCommand : kYCommand];
    if (!signals.is_recorded()) {
      continue;
    }
    const double moved = std::max(range(signals.command), range(signals.measured));
    farthest = std::max(farthest, moved);
    recording.has_moved[axis] = moved >= kLeastMotion;
    if (!recording.has_moved[axis]) {
      recording.notes.push_back(fmt::format("{}: {} moves by {:.3g} mm only; not identified",
                                            recording.file.filename().string(), names[0].name,
                                            moved));
      continue;
    }
    const AxisCheck check{recording, signals, names, axis == hal::kX ? kXCommand : kYCommand};
    TWIN_CHECK(check.units(limits));
    TWIN_CHECK(check.saturation());
    TWIN_CHECK(check.same_signal());
    TWIN_CHECK(check.volts());
    TWIN_CHECK(check.force());
    TWIN_CHECK(check.scale());
    if (roughness(signals.command) > kRougher * roughness(signals.measured)) {
      recording.notes.push_back(fmt::format("{}: {} is much rougher than {}; are they swapped?",
                                            recording.file.filename().string(), names[0].name,
                                            names[1].name));
    }
  }
  if (farthest < kSmallMotion) {
    const Column& column = columns[recording.axis[hal::kX].is_recorded() ? kXCommand : kYCommand];
    return about(
        recording.file,
        farthest > 0.0
            ? fmt::format("no axis moves by more than {:.3g} mm, which shows nothing of a machine; "
                          "is column {} in m ({}:m)?",
                          farthest, column.name, column.name)
            : "no axis moves");
  }
  return {};
}

}  // namespace twin::studies::identify
