#include "studies/identify/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "results/trace/csv_reader.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kUnevenShare = 0.02;         // of the period, by which a row may be off
constexpr double kShortestPeriod = 0.125e-3;  // of an interpolator [s]
constexpr double kLongestPeriod = 4e-3;       // [s]
constexpr std::size_t kFewestRows = 200;
constexpr double kLeastMotion = 0.02;     // an axis that moves less stands still [mm]
constexpr double kSmallMotion = 1.0;      // a whole program of less may be in metres [mm]
constexpr double kFastShare = 20.0;       // of the machine's limit, which no true command exceeds
constexpr double kLeastLikeness = 0.9;    // correlation of command and measured
constexpr double kMostScaleError = 0.05;  // of measured against command
constexpr double kMostVolts = 15.0;       // beyond the converter's range [V]
constexpr double kRougher = 5.0;          // than measured, a command seems to be the wrong one

tl::unexpected<Error> about(const std::filesystem::path& file, std::string message, int line = 0) {
  return tl::unexpected<Error>(Error{ErrorCode::kFile, std::move(message), file.string(), line, 0});
}

/// The signals that the file has, or the error that says what is missing.
Expected<std::vector<std::size_t>> present_signals(const results::CsvReader& reader,
                                                   const ColumnMap& columns,
                                                   const std::filesystem::path& file) {
  std::vector<std::size_t> present{kTime};
  std::string missing;
  const auto want = [&](std::size_t signal) {
    if (reader.has(columns[signal].name)) {
      return true;
    }
    missing += fmt::format("{}{} ({})", missing.empty() ? "" : ", ", columns[signal].name,
                           kSignalNames[signal]);
    return false;
  };
  bool is_complete = want(kTime);
  bool has_axis = false;
  for (const std::size_t first : {kXCommand, kYCommand}) {
    const bool is_named = columns[first].is_required || columns[first + 1].is_required ||
                          columns[first + 2].is_required;
    const bool has_both = reader.has(columns[first].name) && reader.has(columns[first + 1].name);
    if (has_both) {
      present.push_back(first);
      present.push_back(first + 1);
      has_axis = true;
    } else if (is_named) {
      is_complete = want(first) && is_complete;
      is_complete = want(first + 1) && is_complete;
    }
    if (has_both && reader.has(columns[first + 2].name)) {
      present.push_back(first + 2);
    } else if (columns[first + 2].is_required) {
      is_complete = want(first + 2) && is_complete;
    }
  }
  if (!has_axis && is_complete) {
    want(kXCommand);
    want(kXMeasured);
  }
  if (!missing.empty()) {
    return about(file,
                 fmt::format("no column {}; there are: {} (--columns says which is which)", missing,
                             fmt::join(reader.header(), ",")),
                 1);
  }
  return present;
}

std::vector<double>& signal_of(Recording& recording, std::vector<double>& time,
                               std::size_t signal) {
  if (signal == kTime) {
    return time;
  }
  AxisSignals& axis = recording.axis[signal >= kYCommand ? hal::kY : hal::kX];
  switch ((signal - 1) % 3) {
    case 0:
      return axis.command;
    case 1:
      return axis.measured;
    default:
      return axis.volts;
  }
}

/// Refuses a distance between rows that no controller has, with the unit that may be meant.
Expected<void> check_period(double period, const std::filesystem::path& file,
                            const std::string& column) {
  if (!(period > 0.0)) {
    return about(file, fmt::format("time in column {} does not go on", column));
  }
  if (period >= kShortestPeriod && period <= kLongestPeriod) {
    return {};
  }
  const char* const unit = period > 50.0 ? "us" : period > kLongestPeriod ? "ms" : "s";
  return about(file,
               fmt::format("rows are {:g} s apart by column {}, not {:g} to {:g} s: is it in "
                           "{}? then say --columns t={}:{}",
                           period, column, kShortestPeriod, kLongestPeriod, unit, column, unit));
}

/// The period, by the median of the rows' distances; each must be near it.
Expected<double> period_of(const std::vector<double>& time, const std::filesystem::path& file,
                           const std::string& column) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < time.size(); ++k) {
    steps.push_back(time[k] - time[k - 1]);
  }
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  const double median = *middle;
  TWIN_CHECK(check_period(median, file, column));
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (std::abs(steps[k] - median) > kUnevenShare * median) {
      return about(file,
                   fmt::format("time is uneven: column {} goes on by {:g} s here and by {:g} s "
                               "elsewhere; lost or doubled rows?",
                               column, steps[k], median),
                   static_cast<int>(k) + 3);
    }
  }
  const double period = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  return std::round(period * 1e9) / 1e9;
}

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

/// The checks of one axis, with the names of its columns for the messages.
struct AxisCheck {
  const Recording& recording;
  const AxisSignals& signals;
  const Column* columns;  // command, measured, volts

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
            fmt::format("column {} moves {:.4g} times as far as column {}: their units "
                        "differ; say which is in mm, um or m ({}:{})",
                        columns[1].name, slope, columns[0].name, columns[1].name,
                        std::abs(factor) > 1.0 ? "um" : "m"));
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
    if (most > kMostVolts) {
      return refuse(fmt::format("column {} reaches {:.4g} V: is it in mV ({}:mV)?", columns[2].name,
                                most, columns[2].name));
    }
    if (!(range(signals.volts) > 0.0)) {
      return refuse(fmt::format("column {} never changes, though the axis moves", columns[2].name));
    }
    return {};
  }
};

/// The checks of a recording that was read; sets has_moved.
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
    const AxisCheck check{recording, signals, names};
    TWIN_CHECK(check.units(limits));
    TWIN_CHECK(check.same_signal());
    TWIN_CHECK(check.volts());
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
            ? fmt::format("no axis moves by more than {:.3g} mm: is column {} in m ({}:m)?",
                          farthest, column.name, column.name)
            : "no axis moves");
  }
  return {};
}

}  // namespace

Expected<Recording> read_recording(const std::filesystem::path& file, const ColumnMap& columns,
                                   const Limits& limits) {
  TWIN_TRY(results::CsvReader reader, results::CsvReader::open(file));
  TWIN_TRY(const std::vector<std::size_t> signals, present_signals(reader, columns, file));
  std::vector<std::string_view> names;
  for (const std::size_t signal : signals) {
    if (std::ranges::find(names, columns[signal].name) != names.end()) {
      return about(file, fmt::format("column {} is named for two signals", columns[signal].name));
    }
    names.emplace_back(columns[signal].name);
  }
  TWIN_CHECK(reader.select(names));
  Recording recording;
  recording.file = file;
  std::vector<double> time;
  const auto take = [&](std::span<const double> row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t signal = signals[i];
      signal_of(recording, time, signal).push_back(row[i] * columns[signal].to_base);
    }
  };
  TWIN_CHECK(reader.for_each_row(take));
  recording.rows = time.size();
  if (time.size() < kFewestRows) {
    return about(file, fmt::format("{} rows are too few to identify anything; {} at least",
                                   time.size(), kFewestRows));
  }
  TWIN_TRY(recording.period, period_of(time, file, columns[kTime].name));
  TWIN_CHECK(check_recording(recording, columns, limits));
  return recording;
}

}  // namespace twin::studies::identify
