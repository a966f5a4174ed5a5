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
    return tl::unexpected<Error>(
        Error{ErrorCode::kFile,
              fmt::format("no column {}; there are: {} (--columns says which is which)", missing,
                          fmt::join(reader.header(), ",")),
              file.string(), 1, 0});
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

tl::unexpected<Error> about(const std::filesystem::path& file, std::string message, int line = 0) {
  return tl::unexpected<Error>(Error{ErrorCode::kFile, std::move(message), file.string(), line, 0});
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
  if (auto fits = check_period(median, file, column); !fits) {
    return tl::unexpected(fits.error());
  }
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

}  // namespace

Expected<Recording> read_recording(const std::filesystem::path& file, const ColumnMap& columns,
                                   const Limits& limits) {
  auto reader = results::CsvReader::open(file);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  const auto signals = present_signals(*reader, columns, file);
  if (!signals) {
    return tl::unexpected(signals.error());
  }
  std::vector<std::string_view> names;
  for (const std::size_t signal : *signals) {
    if (std::ranges::find(names, columns[signal].name) != names.end()) {
      return about(file, fmt::format("column {} is named for two signals", columns[signal].name));
    }
    names.emplace_back(columns[signal].name);
  }
  if (auto selected = reader->select(names); !selected) {
    return tl::unexpected(selected.error());
  }
  Recording recording;
  recording.file = file;
  std::vector<double> time;
  const auto take = [&](std::span<const double> row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t signal = (*signals)[i];
      signal_of(recording, time, signal).push_back(row[i] * columns[signal].to_base);
    }
  };
  if (auto read = reader->for_each_row(take); !read) {
    return tl::unexpected(read.error());
  }
  recording.rows = time.size();
  if (time.size() < kFewestRows) {
    return about(file, fmt::format("{} rows are too few to identify anything; {} at least",
                                   time.size(), kFewestRows));
  }
  const auto period = period_of(time, file, columns[kTime].name);
  if (!period) {
    return tl::unexpected(period.error());
  }
  recording.period = *period;
  if (auto checked = check_recording(recording, columns, limits); !checked) {
    return tl::unexpected(checked.error());
  }
  return recording;
}

}  // namespace twin::studies::identify
