#include "pictures/figure/value_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twin::pictures {

ValueRange range_of(const results::Table& table, std::size_t column) {
  ValueRange range;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    range.low = std::min(range.low, table.at(i, column));
    range.high = std::max(range.high, table.at(i, column));
  }
  return range;
}

double tic_step(const ValueRange& range) {
  constexpr double kMostSteps = 6.0;
  const double least = std::max(range.high - range.low, 1e-9) / kMostSteps;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * decade >= least * (1.0 - 1e-9)) {
      return digit * decade;
    }
  }
  return 10.0 * decade;
}

std::string y_axis(const ValueRange& values) {
  constexpr double kFlat = 1e-6;  // all values alike: an axis needs some length
  const ValueRange range =
      values.high - values.low > kFlat ? values : ValueRange{values.low, values.low + 1.0};
  const double step = tic_step(range);
  return fmt::format("  set yrange [{:g}:{:g}]\n  set ytics {:g}\n",
                     step * std::floor(range.low / step + 1e-9),
                     step * std::ceil(range.high / step - 1e-9), step);
}

std::string feedrate_axis(double feedrate, Letters letters) {
  return fmt::format("  set yrange [{:g}:{:g}]\n  set ytics 0,{:g}\n",
                     letters == Letters::kBelow ? -0.2 * feedrate : 0.0, 1.12 * feedrate,
                     tic_step({0.0, feedrate}));
}

}  // namespace twin::pictures
