#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/limits.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin::test {

/// A whole trace in memory, by column name.
class TraceRows {
 public:
  explicit TraceRows(const std::filesystem::path& file) {
    auto reader = results::TraceReader::open(file);
    EXPECT_TRUE(reader) << (reader ? "" : to_string(reader.error()));
    if (!reader) {
      return;
    }
    names_ = reader->header();
    std::vector<double> row(names_.size());
    for (;;) {
      const auto has_row = reader->next(row);
      EXPECT_TRUE(has_row) << (has_row ? "" : to_string(has_row.error()));
      if (!has_row || !*has_row) {
        return;
      }
      values_.insert(values_.end(), row.begin(), row.end());
    }
  }

  std::size_t columns() const { return names_.size(); }
  std::size_t rows() const { return names_.empty() ? 0 : values_.size() / names_.size(); }

  std::vector<double> column(std::string_view name) const {
    std::vector<double> column;
    for (std::size_t i = index(name); i < values_.size(); i += names_.size()) {
      column.push_back(values_[i]);
    }
    return column;
  }
  double last(std::string_view name) const { return column(name).back(); }

 private:
  std::size_t index(std::string_view name) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == name) {
        return i;
      }
    }
    ADD_FAILURE() << "no column " << name;
    return values_.size();
  }

  std::vector<std::string> names_;
  std::vector<double> values_;
};

/// Differences of a place along a path, with rest before and after: they never exceed the true
/// peaks.
///
/// @param s          place at successive periods [mm]
/// @param excess     share by which acceleration and jerk may exceed their limits
inline void expect_within_limits(const std::vector<double>& s, double period, const Limits& limits,
                                 double feedrate, double excess = 0.001) {
  std::vector<double> place(3, s.front());
  place.insert(place.end(), s.begin(), s.end());
  place.insert(place.end(), 3, s.back());
  for (std::size_t i = 3; i < place.size(); ++i) {
    const double v0 = (place[i] - place[i - 1]) / period;
    const double v1 = (place[i - 1] - place[i - 2]) / period;
    const double v2 = (place[i - 2] - place[i - 3]) / period;
    ASSERT_LE(v0, feedrate * (1.0 + 1e-6)) << "period " << i - 3;
    ASSERT_GE(v0, -1e-6) << "period " << i - 3;
    ASSERT_LE(std::abs(v0 - v1) / period, limits.acceleration * (1.0 + excess))
        << "period " << i - 3;
    ASSERT_LE(std::abs(v0 - 2.0 * v1 + v2) / (period * period), limits.jerk * (1.0 + excess))
        << "period " << i - 3;
  }
}

}  // namespace twin::test
