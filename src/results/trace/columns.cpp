#include "results/trace/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/units.hpp"

namespace twin::results {
namespace {

constexpr std::size_t kAll = kColumns.size() + kMoreColumns.size();

constexpr const Column& column_at(std::size_t column) {
  return column < kColumns.size() ? kColumns[column] : kMoreColumns[column - kColumns.size()];
}

constexpr std::size_t column_of(std::string_view name) {
  std::size_t column = 0;
  while (column < kAll && column_at(column).name != name) {
    ++column;
  }
  return column;
}

constexpr std::size_t kFirstForce = column_of("x_torque_Nm");

/// Names of all columns, in a row.
std::string all_names() {
  std::string names;
  for (std::size_t i = 0; i < kAll; ++i) {
    names.append(i == 0 ? "" : ", ").append(column_at(i).name);
  }
  return names;
}

/// Columns that a plan has: set points, and what is known of them.
bool is_of_set_point(std::size_t column) {
  return column < kPlanColumns ||
         (column >= kColumns.size() && column <= column_of("command_contour_error_signed_um"));
}

bool is_had(std::size_t column, Layout layout, bool has_forces) {
  return layout == Layout::kPlan ? is_of_set_point(column) : has_forces || column < kFirstForce;
}

using Values = std::array<double, kAll>;

Values values_of(const Sample& sample, const Deviations& deviations) {
  using units::um_from_mm;
  const Vec2 tracking_error = sample.command.head<2>() - sample.encoder;  // [mm]
  return {sample.t,
          static_cast<double>(sample.segment),
          static_cast<double>(sample.line),
          sample.command.x(),
          sample.command.y(),
          sample.command.z(),
          sample.feedrate,
          sample.encoder.x(),
          sample.encoder.y(),
          sample.table.x(),
          sample.table.y(),
          sample.volts.x(),
          sample.volts.y(),
          um_from_mm(deviations.contour_error),
          um_from_mm(tracking_error.x()),
          um_from_mm(tracking_error.y()),
          deviations.path_length,
          std::isfinite(sample.feedrate_limit) ? sample.feedrate_limit : 0.0,
          sample.command.z() <= deviations.pen_up ? 1.0 : 0.0,
          deviations.is_rapid ? 1.0 : 0.0,
          um_from_mm(deviations.signed_command_error),
          um_from_mm(deviations.signed_contour_error),
          um_from_mm(deviations.signed_table_error),
          sample.is_passed_over ? 1.0 : 0.0,
          sample.torque.x(),
          sample.torque.y(),
          sample.friction.x(),
          sample.friction.y()};
}

}  // namespace

ColumnChoice columns_of(Layout layout) {
  ColumnChoice columns(layout == Layout::kPlan ? kPlanColumns : kColumns.size());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  return columns;
}

Expected<ColumnChoice> choose_columns(std::string_view text, Layout layout, bool has_forces) {
  ColumnChoice chosen;
  const auto add = [&chosen](std::size_t column) {
    if (std::ranges::find(chosen, column) == chosen.end()) {
      chosen.push_back(column);
    }
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view name = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t column = column_of(name);
    if (name == "default" || name == "all") {
      for (std::size_t i = 0; i < (name == "all" ? kAll : kColumns.size()); ++i) {
        if (is_had(i, layout, has_forces)) {
          add(i);
        }
      }
    } else if (column < kAll && is_had(column, layout, has_forces)) {
      add(column);
    } else if (column < kAll) {
      return fail(ErrorCode::kUsage,
                  fmt::format("--columns: {} is not known {}", name,
                              layout == Layout::kPlan ? "of a plan, where no machine moves"
                                                      : "of this machine, only of --hal mujoco"));
    } else {
      return fail(ErrorCode::kUsage,
                  fmt::format("--columns: there is no column '{}'; there are default, all, {}",
                              name, all_names()));
    }
  }
  return chosen;
}

TraceHeader trace_header(const ColumnChoice& columns, double period) {
  TraceHeader header{.columns = {}, .period = period};
  for (const std::size_t column : columns) {
    const Column& known = column_at(column);
    header.columns.push_back(
        {.name = std::string(known.name),
         .kind = known.is_whole ? TraceColumn::Kind::kWhole : TraceColumn::Kind::kReal,
         .unit = std::string(known.unit),
         .long_name = std::string(known.long_name)});
  }
  return header;
}

TraceHeader trace_header(Layout layout, double period) {
  return trace_header(columns_of(layout), period);
}

void append_row(const Sample& sample, const Deviations& deviations, const ColumnChoice& columns,
                std::vector<double>& rows) {
  const Values values = values_of(sample, deviations);
  for (const std::size_t column : columns) {
    rows.push_back(values[column]);
  }
}

void append_row(const Sample& sample, double contour_error, Layout layout,
                std::vector<double>& rows) {
  append_row(sample, Deviations{.contour_error = contour_error}, columns_of(layout), rows);
}

}  // namespace twin::results
