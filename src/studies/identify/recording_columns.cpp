#include "studies/identify/recording_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "config/nearest_name.hpp"

namespace twin::studies::identify {
namespace {

struct Unit {
  std::string_view name;
  char quantity;  // s time, m length, V voltage
  double to_base;
};

constexpr std::array<Unit, 8> kUnits{{{"s", 's', 1.0},
                                      {"ms", 's', 1e-3},
                                      {"us", 's', 1e-6},
                                      {"m", 'm', 1e3},
                                      {"mm", 'm', 1.0},
                                      {"um", 'm', 1e-3},
                                      {"V", 'V', 1.0},
                                      {"mV", 'V', 1e-3}}};

char quantity_of(std::size_t signal) {
  if (signal == kTime) {
    return 's';
  }
  return signal == kXVolts || signal == kYVolts ? 'V' : 'm';
}

/// Takes ":UNIT" off the end of a column's name.
Expected<double> take_unit(std::string& name, std::size_t signal) {
  const std::size_t colon = name.rfind(':');
  if (colon == std::string::npos) {
    return 1.0;
  }
  const std::string unit = name.substr(colon + 1);
  const auto found = std::ranges::find(kUnits, std::string_view(unit), &Unit::name);
  if (found == kUnits.end()) {
    return 1.0;  // part of the name
  }
  if (found->quantity != quantity_of(signal)) {
    return fail(ErrorCode::kUsage,
                fmt::format("--columns: {} cannot be in {}", kSignalNames[signal], unit));
  }
  name.resize(colon);
  return found->to_base;
}

Expected<void> parse_one(std::string_view text, ColumnMap& map) {
  const std::size_t equals = text.find('=');
  const std::string_view signal = text.substr(0, equals);
  const auto found = std::ranges::find(kSignalNames, signal);
  if (equals == std::string_view::npos || found == kSignalNames.end()) {
    const std::vector<std::string> names(kSignalNames.begin(), kSignalNames.end());
    return fail(
        ErrorCode::kUsage,
        fmt::format("--columns: '{}' is not SIGNAL=COLUMN with one of t, x_cmd, x_meas, x_V, "
                    "y_cmd, y_meas, y_V{}",
                    text, config::did_you_mean(signal, names)));
  }
  const auto index = static_cast<std::size_t>(found - kSignalNames.begin());
  Column column{std::string(text.substr(equals + 1)), 1.0, true};
  TWIN_TRY(const auto to_base, take_unit(column.name, index));
  if (column.name.empty()) {
    return fail(ErrorCode::kUsage, fmt::format("--columns: no column is named for {}", signal));
  }
  column.to_base = to_base;
  map[index] = column;
  return {};
}

}  // namespace

ColumnMap trace_columns() {
  return {{{"t_s", 1.0, true},
           {"x_cmd_mm"},
           {"x_enc_mm"},
           {"x_drive_V"},
           {"y_cmd_mm"},
           {"y_enc_mm"},
           {"y_drive_V"}}};
}

Expected<ColumnMap> parse_columns(std::string_view text) {
  ColumnMap map = trace_columns();
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    TWIN_CHECK(parse_one(text.substr(0, comma), map));
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return map;
}

}  // namespace twin::studies::identify
