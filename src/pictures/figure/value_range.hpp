#pragma once

#include <string>

#include "results/trace/decimator.hpp"

namespace twin::pictures {

/// Range of the values on an axis.
struct ValueRange {
  double low = 0.0;
  double high = 0.0;
};

/// Least and largest value of a column and 0.
ValueRange range_of(const results::Table& table, std::size_t column);

/// Distance between the numbers on an axis: 1, 2 or 5 times a power of ten, at most seven of them.
double tic_step(const ValueRange& range);

/// gnuplot commands for the vertical axis: whole steps, few enough numbers to read.
std::string y_axis(const ValueRange& values);

/// Whether an axis leaves room for letters below the curve.
enum class Letters { kNone, kBelow };

/// The same for feedrates from 0.
///
/// @param feedrate  programmed [mm/s]
std::string feedrate_axis(double feedrate, Letters letters = Letters::kNone);

}  // namespace twin::pictures
