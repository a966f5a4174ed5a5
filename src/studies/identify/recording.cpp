#include "studies/identify/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>

#include "results/trace/trace_reader.hpp"
#include "studies/identify/recording_checks.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kJump = 50.0;                // rows that time jumps over where a recording ends
constexpr double kUnevenShare = 0.02;         // of the period, by which a row may be off
constexpr double kShortestPeriod = 0.125e-3;  // of an interpolator [s]
constexpr double kLongestPeriod = 4e-3;       // [s]
constexpr std::size_t kFewestRows = 200;

/// The signals that the file has, or the error that says what is missing.
Expected<std::vector<std::size_t>> present_signals(const results::TraceReader& reader,
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
    const auto of_axis = std::span(columns).subspan(first, kSignalsOfAxis);
    const bool is_named =
        std::ranges::any_of(of_axis, [](const Column& column) { return column.is_required; });
    const bool has_both = reader.has(columns[first].name) && reader.has(columns[first + 1].name);
    if (has_both) {
      present.push_back(first);
      present.push_back(first + 1);
      has_axis = true;
    } else if (is_named) {
      is_complete = want(first) && is_complete;
      is_complete = want(first + 1) && is_complete;
    }
    for (std::size_t signal = first + 2; signal < first + kSignalsOfAxis; ++signal) {
      if (has_both && !columns[signal].name.empty() && reader.has(columns[signal].name)) {
        present.push_back(signal);
      } else if (columns[signal].is_required) {
        is_complete = want(signal) && is_complete;
      }
    }
    if (columns[first + 3].is_required && columns[first + 4].is_required) {
      return fail(ErrorCode::kUsage,
                  fmt::format("--columns: {} and {} are the same twice; name one",
                              kSignalNames[first + 3], kSignalNames[first + 4]));
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
  switch ((signal - 1) % kSignalsOfAxis) {
    case 0:
      return axis.command;
    case 1:
      return axis.measured;
    case 2:
      return axis.volts;
    case 5:
      return axis.scale;
    default:
      return axis.force;
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
  return about(
      file,
      fmt::format("rows are {:g} s apart by column {}, not {:g} to {:g} s: is it in "
                  "{}? then say --columns t={}:{}; if it counts rows of 2 ms, t={}:2ms",
                  period, column, kShortestPeriod, kLongestPeriod, unit, column, unit, column));
}

/// Times that go on evenly, and their place in the file.
struct Evenly {
  std::size_t first = 0;
  std::size_t rows = 0;
  double period = 0.0;  // [s]
};

/// Cuts time where it jumps. The period is the median of the rows' distances; within a piece each
/// must be near it.
Expected<std::vector<Evenly>> cut_where_time_jumps(const std::vector<double>& time,
                                                   const std::filesystem::path& file,
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
  std::vector<Evenly> pieces{{0, 1, 0.0}};
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (std::abs(steps[k]) > kJump * median) {
      pieces.push_back({k + 1, 1, 0.0});
      continue;
    }
    if (std::abs(steps[k] - median) > kUnevenShare * median) {
      return about(file,
                   fmt::format("time is uneven: column {} goes on by {:g} s here and by {:g} s "
                               "elsewhere; lost or doubled rows?",
                               column, steps[k], median),
                   static_cast<int>(k) + 3);
    }
    ++pieces.back().rows;
  }
  for (Evenly& piece : pieces) {
    const double length = time[piece.first + piece.rows - 1] - time[piece.first];
    piece.period = std::round(length / static_cast<double>(piece.rows - 1) * 1e9) / 1e9;
  }
  return pieces;
}

/// The signals of a file, all rows.
struct Rows {
  std::vector<double> time;
  Recording signals;
};

Expected<Rows> read_rows(const std::filesystem::path& file, const ColumnMap& columns) {
  TWIN_TRY(results::TraceReader reader, results::TraceReader::open(file));
  TWIN_TRY(const std::vector<std::size_t> signals, present_signals(reader, columns, file));
  std::vector<std::string_view> names;
  for (const std::size_t signal : signals) {
    if (std::ranges::find(names, columns[signal].name) != names.end()) {
      return about(file, fmt::format("column {} is named for two signals", columns[signal].name));
    }
    names.emplace_back(columns[signal].name);
  }
  TWIN_CHECK(reader.select(names));
  Rows rows;
  for (const std::size_t signal : signals) {
    AxisSignals& axis = rows.signals.axis[signal >= kYCommand ? hal::kY : hal::kX];
    if (signal == kXVolts || signal == kYVolts) {
      axis.volts_in = columns[signal].quantity;
    } else if (signal == kXTorque || signal == kYTorque) {
      axis.force_in = Quantity::kTorque;
    }
  }
  const auto take = [&](std::span<const double> row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t signal = signals[i];
      signal_of(rows.signals, rows.time, signal).push_back(row[i] * columns[signal].to_base);
    }
  };
  TWIN_CHECK(reader.for_each_row(take));
  return rows;
}

/// One piece of the rows of a file.
Recording piece_of(const Rows& rows, const Evenly& piece, const std::filesystem::path& file) {
  Recording recording;
  recording.file = file;
  recording.rows = piece.rows;
  recording.period = piece.period;
  recording.first_row = piece.first;
  const auto cut = [&](const std::vector<double>& all) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(all.empty() ? 0 : piece.first);
    return std::vector<double>(begin,
                               begin + static_cast<std::ptrdiff_t>(all.empty() ? 0 : piece.rows));
  };
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    const AxisSignals& all = rows.signals.axis[axis];
    recording.axis[axis] = {cut(all.command), cut(all.measured), cut(all.volts), all.volts_in,
                            cut(all.force),   all.force_in,      cut(all.scale)};
  }
  return recording;
}

}  // namespace

Expected<std::vector<Recording>> read_recordings(const std::filesystem::path& file,
                                                 const ColumnMap& columns, const Limits& limits) {
  TWIN_TRY(const Rows rows, read_rows(file, columns));
  if (rows.time.size() < kFewestRows) {
    return about(file, fmt::format("{} rows are too few to identify anything; {} at least",
                                   rows.time.size(), kFewestRows));
  }
  TWIN_TRY(const auto pieces, cut_where_time_jumps(rows.time, file, columns[kTime].name));
  std::vector<Recording> recordings;
  std::vector<std::string> notes;
  std::optional<Error> refused;
  for (const Evenly& piece : pieces) {
    if (piece.rows < kFewestRows) {
      notes.push_back(fmt::format("{}: {} rows from line {} on are too few and left out",
                                  file.filename().string(), piece.rows, piece.first + 2));
      continue;
    }
    Recording recording = piece_of(rows, piece, file);
    if (auto checked = check_recording(recording, columns, limits); !checked) {
      if (pieces.size() == 1) {
        return tl::unexpected(checked.error());
      }
      refused = checked.error();
      notes.push_back(fmt::format("{}: what begins in line {} is left out: {}",
                                  file.filename().string(), piece.first + 2, refused->message));
      continue;
    }
    recordings.push_back(std::move(recording));
  }
  if (recordings.empty()) {
    return refused ? Expected<std::vector<Recording>>(tl::unexpected(*refused))
                   : about(file, fmt::format("time jumps so often that no {} rows go on evenly",
                                             kFewestRows));
  }
  std::ranges::move(notes, std::back_inserter(recordings.front().notes));
  return recordings;
}

Expected<Recording> read_recording(const std::filesystem::path& file, const ColumnMap& columns,
                                   const Limits& limits) {
  TWIN_TRY(auto recordings, read_recordings(file, columns, limits));
  if (recordings.size() > 1) {
    return about(file, "time jumps here: the file has several recordings",
                 static_cast<int>(recordings[1].first_row) + 2);
  }
  return std::move(recordings.front());
}

}  // namespace twin::studies::identify
