#include "studies/identify/recording_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "config/nearest_name.hpp"

namespace twin::studies::identify {
namespace {

struct Unit {
  std::string_view name;
  Quantity quantity;
  double to_base;
};

constexpr std::array kUnits{Unit{"s", Quantity::kTime, 1.0},
                            Unit{"ms", Quantity::kTime, 1e-3},
                            Unit{"us", Quantity::kTime, 1e-6},
                            Unit{"m", Quantity::kLength, 1e3},
                            Unit{"mm", Quantity::kLength, 1.0},
                            Unit{"um", Quantity::kLength, 1e-3},
                            Unit{"V", Quantity::kVoltage, 1.0},
                            Unit{"mV", Quantity::kVoltage, 1e-3},
                            Unit{"mm/s", Quantity::kSpeed, 1.0},
                            Unit{"mm_per_s", Quantity::kSpeed, 1.0},
                            Unit{"m/s", Quantity::kSpeed, 1e3},
                            Unit{"m_per_s", Quantity::kSpeed, 1e3},
                            Unit{"rpm", Quantity::kRotationSpeed, 1.0},
                            Unit{"N", Quantity::kForce, 1.0},
                            Unit{"kN", Quantity::kForce, 1e3},
                            Unit{"N_m", Quantity::kTorque, 1.0},
                            Unit{"Nm", Quantity::kTorque, 1.0},
                            Unit{"mN_m", Quantity::kTorque, 1e-3}};

/// What a signal is measured in where no unit is named.
constexpr std::array<Quantity, kSignalsOfAxis> kQuantities{Quantity::kLength,  Quantity::kLength,
                                                           Quantity::kVoltage, Quantity::kForce,
                                                           Quantity::kTorque,  Quantity::kLength};

Quantity quantity_of(std::size_t signal) {
  return signal == kTime ? Quantity::kTime : kQuantities[(signal - 1) % kSignalsOfAxis];
}

bool can_be_in(std::size_t signal, Quantity quantity) {
  const Quantity usual = quantity_of(signal);
  return quantity == usual ||
         (usual == Quantity::kVoltage &&
          (quantity == Quantity::kSpeed || quantity == Quantity::kRotationSpeed));
}

/// The period in seconds that "2ms" names; nothing for another text.
std::optional<double> period_named(const std::string& text) {
  char* rest = nullptr;
  const double number = std::strtod(text.c_str(), &rest);
  const auto unit = std::ranges::find(kUnits, std::string_view(rest), &Unit::name);
  const bool is_period = rest != text.c_str() && number > 0.0 && std::isfinite(number) &&
                         unit != kUnits.end() && unit->quantity == Quantity::kTime;
  return is_period ? std::optional(number * unit->to_base) : std::nullopt;
}

/// Takes ":UNIT" off the end of a column's name.
Expected<void> take_unit(Column& column, std::size_t signal) {
  const std::size_t colon = column.name.rfind(':');
  if (colon == std::string::npos) {
    return {};
  }
  const std::string unit = column.name.substr(colon + 1);
  const auto period = signal == kTime ? period_named(unit) : std::nullopt;
  const auto found = std::ranges::find(kUnits, std::string_view(unit), &Unit::name);
  if (found == kUnits.end() && !period) {
    return {};  // part of the name
  }
  if (!period && !can_be_in(signal, found->quantity)) {
    return fail(ErrorCode::kUsage,
                fmt::format("--columns: {} cannot be in {}", kSignalNames[signal], unit));
  }
  column.name.resize(colon);
  column.to_base = period ? *period : found->to_base;
  column.quantity = period ? Quantity::kTime : found->quantity;
  return {};
}

Expected<void> parse_one(std::string_view text, ColumnMap& map) {
  const std::size_t equals = text.find('=');
  const std::string_view signal = text.substr(0, equals);
  const auto found = std::ranges::find(kSignalNames, signal);
  if (equals == std::string_view::npos || found == kSignalNames.end()) {
    const std::vector<std::string> names(kSignalNames.begin(), kSignalNames.end());
    return fail(ErrorCode::kUsage,
                fmt::format("--columns: '{}' is not SIGNAL=COLUMN with one of {}{}", text,
                            fmt::join(kSignalNames, ", "), config::did_you_mean(signal, names)));
  }
  const auto index = static_cast<std::size_t>(found - kSignalNames.begin());
  Column column{std::string(text.substr(equals + 1)), 1.0, true, quantity_of(index)};
  TWIN_CHECK(take_unit(column, index));
  if (column.name.empty()) {
    return fail(ErrorCode::kUsage, fmt::format("--columns: no column is named for {}", signal));
  }
  map[index] = column;
  return {};
}

}  // namespace

ColumnMap trace_columns() {
  ColumnMap map;
  for (std::size_t signal = 0; signal < kSignals; ++signal) {
    map[signal].quantity = quantity_of(signal);
  }
  map[kTime].name = "t_s";
  map[kTime].is_required = true;
  map[kXCommand].name = "x_cmd_mm";
  map[kXMeasured].name = "x_enc_mm";
  map[kXVolts].name = "x_drive_V";
  map[kYCommand].name = "y_cmd_mm";
  map[kYMeasured].name = "y_enc_mm";
  map[kYVolts].name = "y_drive_V";
  return map;
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
