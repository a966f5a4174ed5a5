#include "studies/reproduce/published.hpp"

#include <fmt/format.h>

#include <cmath>

#include "config/toml_file.hpp"
#include "studies/reproduce/published_columns.hpp"

namespace twin::studies::reproduce {

extern const char* const kWangYauToml;  // made from wang_yau.toml when the program is built

namespace {

constexpr const char* kFile = "wang_yau.toml";

tl::unexpected<Error> complaint(const toml::node& node, const std::string& message) {
  const auto place = node.source().begin;
  return tl::unexpected<Error>(Error{ErrorCode::kFile, message, kFile, static_cast<int>(place.line),
                                     static_cast<int>(place.column)});
}

Expected<PublishedRow> read_row(const toml::table& source) {
  PublishedRow row;
  row.table = source["table"].value_or(0);
  row.program = source["program"].value_or(std::string());
  row.interpolator = source["interpolator"].value_or(std::string());
  row.feedrate_mm_per_min = source["programmed_feedrate_mm_per_min"].value_or(0.0);
  if (columns_of(row.table).empty() || row.program.empty() || row.interpolator.empty() ||
      !(row.feedrate_mm_per_min > 0.0)) {
    return complaint(source,
                     "a row needs table, program, interpolator and programmed_feedrate_mm_per_min");
  }
  if (const toml::array* settings = source["settings"].as_array()) {
    for (const toml::node& setting : *settings) {
      row.settings.push_back(setting.value_or(std::string()));
    }
  }
  for (const PublishedColumn& column : columns_of(row.table)) {
    const auto value = source.at_path(column.key).value<double>();
    if (!value || !std::isfinite(*value)) {
      return complaint(source, fmt::format("this row has no number {}", column.key));
    }
    row.values.push_back(*value);
  }
  return row;
}

std::string thousands(double x) {
  const auto whole = std::llround(x);
  return whole < 1000 ? fmt::format("{}", whole)
                      : fmt::format("{},{:03}", whole / 1000, whole % 1000);
}

}  // namespace

std::string PublishedRow::short_name() const {
  const std::string kind = interpolator == "nurbs"    ? "NURBS"
                           : interpolator == "bezier" ? "Fast Bezier"
                                                      : interpolator;
  return kind + " " + thousands(feedrate_mm_per_min);
}

std::string PublishedRow::name() const { return program + ", " + short_name() + " mm/min"; }

Expected<Published> parse_published(std::string_view toml) {
  TWIN_TRY(const toml::table root, config::parse_toml(toml, kFile));
  Published result;
  result.source = root["source"].value_or(std::string());
  const toml::array* rows = root["row"].as_array();
  if (result.source.empty() || rows == nullptr) {
    return complaint(root, "a source and rows are needed");
  }
  for (const toml::node& node : *rows) {
    if (!node.is_table()) {
      return complaint(node, "is not a row");
    }
    TWIN_TRY(PublishedRow row, read_row(*node.as_table()));
    result.rows.push_back(std::move(row));
  }
  return result;
}

Expected<Published> published() { return parse_published(kWangYauToml); }

}  // namespace twin::studies::reproduce
