#include "studies/compare/comparison_files.hpp"

#include <fmt/format.h>

#include <array>

#include "core/json.hpp"
#include "results/quantities.hpp"
#include "studies/compare/comparison_pictures.hpp"

namespace twin::studies::compare {
namespace {

using results::Quantity;

/// What contestants are compared by, in the order of the tables.
constexpr std::array<std::string_view, 25> kKeys{"planned_time_s",
                                                 "time_bound_s",
                                                 "bound_ratio",
                                                 "machining_time_s",
                                                 "segments",
                                                 "compression_factor",
                                                 "certified_deviation_um",
                                                 "command_contour_error_max_um",
                                                 "command_contour_error_rms_um",
                                                 "contour_error_max_um",
                                                 "contour_error_rms_um",
                                                 "table_contour_error_max_um",
                                                 "table_contour_error_rms_um",
                                                 "x_tracking_error_max_um",
                                                 "x_tracking_error_rms_um",
                                                 "y_tracking_error_max_um",
                                                 "y_tracking_error_rms_um",
                                                 "feedrate_peak_mm_per_s",
                                                 "tangential_acceleration_peak_mm_per_s2",
                                                 "normal_acceleration_peak_mm_per_s2",
                                                 "tangential_jerk_peak_mm_per_s3",
                                                 "feedrate_fluctuation_max_percent",
                                                 "feedrate_fluctuation_rms_percent",
                                                 "planning_time_ms",
                                                 "planning_time_per_block_us"};

std::string percent_text(double share) { return fmt::format("{:.3g}", 100.0 * share); }

}  // namespace

TextTable grid_of_interpolators(const Comparison& comparison) {
  TextTable grid;
  grid.title = fmt::format("{} on {} ({}), period {:g} ms", comparison.program, comparison.machine,
                           comparison.hal, 1e3 * comparison.period);
  for (const Contestant& contestant : comparison.contestants) {
    grid.head.push_back(contestant.planner == "paper" ? "paper " + contestant.name
                                                      : contestant.name);
  }
  grid.head.emplace_back("limit");
  for (const std::string_view key : kKeys) {
    const Quantity& q = results::quantity(key);
    Line line{.row = q.name(), .what = std::string(q.unit), .cells = {}, .note = {}};
    for (const Contestant& contestant : comparison.contestants) {
      line.cells.push_back({q.text(q.get(contestant.summary))});
    }
    line.cells.push_back({q.limit == nullptr ? "" : q.text(q.limit(comparison.limits))});
    grid.lines.push_back(std::move(line));
  }
  return grid;
}

TextTable grid_of_fluctuations(const Comparison& comparison) {
  TextTable grid;
  grid.title = "Feedrate fluctuation under each parameter update, in % of the commanded feedrate";
  std::string shown;
  for (const Fluctuation& f : comparison.fluctuations) {
    const std::string name = fmt::format("{}, feedrate rule: {}", f.program, f.feedrate_rule);
    if (name != shown) {
      shown = name;
      grid.lines.push_back({.row = name, .what = "max", .cells = {}, .note = {}});
      grid.lines.push_back({.row = {}, .what = "RMS", .cells = {}, .note = {}});
    }
    const std::size_t n = grid.lines.size();
    grid.lines[n - 2].cells.push_back({percent_text(f.shares.max)});
    grid.lines[n - 1].cells.push_back({percent_text(f.shares.rms)});
    if (grid.lines.size() == 2) {
      grid.head.push_back(f.parameter_update);
    }
  }
  return grid;
}

std::string interpolators_csv(const Comparison& comparison) {
  std::string text = "figure,unit";
  for (const Contestant& contestant : comparison.contestants) {
    text += "," + contestant.name;
  }
  text += "\n";
  for (const std::string_view key : kKeys) {
    const Quantity& q = results::quantity(key);
    text += fmt::format("{},{}", key, q.unit);
    for (const Contestant& contestant : comparison.contestants) {
      const auto value = q.get(contestant.summary);
      text += value ? fmt::format(",{:.6g}", *value) : ",";
    }
    text += "\n";
  }
  return text;
}

std::string fluctuations_csv(const Comparison& comparison) {
  std::string text = "program,feedrate_rule,parameter_update,max_percent,rms_percent\n";
  for (const Fluctuation& f : comparison.fluctuations) {
    text += fmt::format("{},{},{},{:.6g},{:.6g}\n", quote_csv(f.program), f.feedrate_rule,
                        f.parameter_update, 100.0 * f.shares.max, 100.0 * f.shares.rms);
  }
  return text;
}

std::string json_text(const Comparison& comparison) {
  Json json{{"program", comparison.program},
            {"machine", comparison.machine},
            {"hal", comparison.hal},
            {"period_s", rounded(comparison.period)}};
  for (const Contestant& contestant : comparison.contestants) {
    Json& values = json["interpolators"][contestant.name];
    for (const std::string_view key : kKeys) {
      values[std::string(key)] = rounded_or_null(results::quantity(key).get(contestant.summary));
    }
  }
  json["feedrate_fluctuation"] = Json::array();
  for (const Fluctuation& f : comparison.fluctuations) {
    json["feedrate_fluctuation"].push_back({{"program", f.program},
                                            {"feedrate_rule", f.feedrate_rule},
                                            {"parameter_update", f.parameter_update},
                                            {"max_percent", rounded(100.0 * f.shares.max)},
                                            {"rms_percent", rounded(100.0 * f.shares.rms)}});
  }
  return to_text(json);
}

std::string markdown_text(const Comparison& comparison) {
  std::string text =
      "# Planners and interpolators compared\n\n" + to_markdown(grid_of_interpolators(comparison));
  if (!comparison.fluctuations.empty()) {
    text += to_markdown(grid_of_fluctuations(comparison));
  }
  return text;
}

Expected<void> write_results(const Comparison& comparison, const pictures::Workshop& workshop,
                             pictures::Drawing drawing) {
  if (drawing == pictures::Drawing::kDrawn) {
    TWIN_CHECK(draw_figures(comparison, workshop.pictures()));
  }
  const pictures::NamedText texts[] = {{"compare.csv", interpolators_csv(comparison)},
                                       {"fluctuation.csv", fluctuations_csv(comparison)},
                                       {"compare.json", json_text(comparison)},
                                       {"compare.md", markdown_text(comparison)}};
  return workshop.deliver_study(texts, drawing);
}

}  // namespace twin::studies::compare
