#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/reproduce/counts.hpp"
#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction_files.hpp"

namespace twin::studies::reproduce {
namespace {

std::size_t column(int table, std::string_view key) {
  const auto columns = columns_of(table);
  return static_cast<std::size_t>(std::ranges::find(columns, key, &PublishedColumn::key) -
                                  columns.begin());
}

/// Ours / published of one column over some rows, least and largest, and how it is written.
struct Range {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  bool is_empty() const { return low > high; }
  std::string text() const { return fmt::format("{:.2f} to {:.2f}", low, high); }
};

/// Mean ratios of the measured rows of an interpolator.
Range ratios(const Variant& variant, const std::string& interpolator,
             std::initializer_list<std::string_view> keys) {
  Range range;
  for (const Answer& answer : variant.answers) {
    const PublishedRow& row = answer.published;
    if (!is_measured(row.table) || row.interpolator != interpolator) {
      continue;
    }
    for (const std::string_view key : keys) {
      const std::size_t i = column(row.table, key);
      const double ratio = ours(answer, i, Of::kMean) / row.values[i];
      range.low = std::min(range.low, ratio);
      range.high = std::max(range.high, ratio);
    }
  }
  return range;
}

std::string curves(const Reproduction& reproduction) {
  std::string text =
      "The programs of the paper are lost; ours are stand-ins with its block "
      "statistics and path lengths, not its outlines. So single maxima, which one "
      "place of an outline makes, are comparable to some 30 % only.";
  std::string counts;
  for (const Answer& answer : reproduction.defaults().answers) {
    if (answer.published.table == 3) {
      const std::size_t i = column(3, "blocks_after");
      counts += fmt::format("{}{:.0f} curves for {} (paper: {:.0f})", counts.empty() ? "" : ", ",
                            answer.single[i], answer.published.program, answer.published.values[i]);
    }
  }
  return counts.empty()
             ? text
             : text + fmt::format(
                          " They have no place that breaks a run of short blocks: {}, the "
                          "least that 20 blocks a curve allow.",
                          counts);
}

std::string remainder(const Reproduction& reproduction) {
  const auto keys = {std::string_view("x_um.max"), std::string_view("y_um.max")};
  const Range land = ratios(reproduction.as_published(), "nurbs", keys);
  const Range carry = ratios(reproduction.defaults(), "nurbs", keys);
  return fmt::format(
      "The paper steps a curve until u >= u_max, which cuts the last step of each curve short: an "
      "error along the path of up to F T, which moves the tracking maxima and leaves the contour "
      "error alone. That it did so on the rig is our reading, not its word. 'as published' does "
      "the same: tracking maxima of the NURBS rows {} of the published ones. By default the "
      "remainder of the period goes on into the next curve: {}.",
      land.text(), carry.text());
}

std::string rms(const Reproduction& reproduction) {
  const Range range =
      ratios(reproduction.as_published(), "nurbs", {"contour_um.rms", "x_um.rms", "y_um.rms"});
  return fmt::format(
      "Drive, friction and servo values are fits to these tables, not measurements of the rig. "
      "RMS errors hardly depend on the outline: {} of the published ones in the NURBS rows.",
      range.text());
}

std::string times(const Reproduction& reproduction) {
  const Range nurbs = ratios(reproduction.as_published(), "nurbs", {"time_s"});
  const Range bezier = ratios(reproduction.as_published(), "bezier", {"time_s"});
  return fmt::format(
      "Machining times: NURBS rows {:.3f} to {:.3f}, Fast Bezier rows {:.3f} to {:.3f} of the "
      "published ones. Length and shape of the approach and of the tight rounds are not published, "
      "and how much a slow-down costs depends on them.",
      nurbs.low, nurbs.high, bezier.low, bezier.high);
}

}  // namespace

std::string unreached(const Reproduction& reproduction) {
  std::string text;
  for (const Answer& answer : reproduction.as_published().answers) {
    const std::string names = missed(answer, Of::kMean);
    if (is_measured(answer.published.table) && !names.empty()) {
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", answer.published.name(), names);
    }
  }
  return text.empty() ? "No number of Tables 4 and 5 is more than 30 % off as published."
                      : "Not reached (more than 30 % off, as published, mean): " + text + ".";
}

std::vector<std::string> differences(const Reproduction& reproduction) {
  std::vector<std::string> list{
      curves(reproduction), remainder(reproduction), rms(reproduction), times(reproduction),
      unreached(reproduction) +
          " The paper has one run a row: a maximum is a single extreme sample."};
  list.push_back(
      "The contour error of the command is smaller than in Table 3: successive curves share "
      "tangent and curvature at their joints, and a curve is held against the polygon over its "
      "whole length, not at three points.");
  list.push_back(
      "The maximum feedrate of a tight round (Eq. 6) holds at the round only, not along the whole "
      "curve; the parameter of a curve follows its arc length exactly, where Eq. 23 approximates.");
  if (reproduction.repeats > 0) {
    list.push_back(fmt::format(
        "Repeats differ in where the encoders and the mains hum are in their cycle: {} runs a row, "
        "evenly spread, the same every time.",
        reproduction.repeats));
  }
  return list;
}

}  // namespace twin::studies::reproduce
