#include "studies/compare/texts.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/rounded.hpp"
#include "studies/compare/figure_kinds.hpp"

namespace twin::studies::compare {
namespace {

using Json = nlohmann::ordered_json;

/// A figure as the table shows it: "-" for a certified deviation where the planner gives none.
std::string shown(const FigureKind& kind, double value) {
  const bool is_absent = kind.key == "certified_deviation_um" && value == 0.0;
  return is_absent ? "-" : fmt::format("{:.{}f}", value, kind.decimals);
}

std::string percent(double share) { return fmt::format("{:.3g}", 100.0 * share); }

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
  for (const FigureKind& kind : figure_kinds()) {
    Line line{std::string(kind.name), std::string(kind.unit), {}, {}};
    for (const Contestant& contestant : comparison.contestants) {
      line.cells.push_back({shown(kind, kind.get(contestant))});
    }
    line.cells.push_back({kind.limit == nullptr ? "" : shown(kind, kind.limit(comparison.limits))});
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
      grid.lines.push_back({name, "max", {}, {}});
      grid.lines.push_back({"", "RMS", {}, {}});
    }
    const std::size_t n = grid.lines.size();
    grid.lines[n - 2].cells.push_back({percent(f.shares.max)});
    grid.lines[n - 1].cells.push_back({percent(f.shares.rms)});
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
  for (const FigureKind& kind : figure_kinds()) {
    text += fmt::format("{},{}", kind.key, kind.unit);
    for (const Contestant& contestant : comparison.contestants) {
      text += fmt::format(",{:.6g}", kind.get(contestant));
    }
    text += "\n";
  }
  return text;
}

std::string fluctuations_csv(const Comparison& comparison) {
  std::string text = "program,feedrate_rule,parameter_update,max_percent,rms_percent\n";
  for (const Fluctuation& f : comparison.fluctuations) {
    text += fmt::format("\"{}\",{},{},{:.6g},{:.6g}\n", f.program, f.feedrate_rule,
                        f.parameter_update, 100.0 * f.shares.max, 100.0 * f.shares.rms);
  }
  return text;
}

std::string json_text(const Comparison& comparison) {
  Json json{{"program", comparison.program},
            {"machine", comparison.machine},
            {"hal", comparison.hal},
            {"period_s", comparison.period}};
  for (const Contestant& contestant : comparison.contestants) {
    for (const FigureKind& kind : figure_kinds()) {
      json["interpolators"][contestant.name][std::string(kind.key)] = rounded(kind.get(contestant));
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
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string markdown_text(const Comparison& comparison) {
  std::string text =
      "# Planners and interpolators compared\n\n" + to_markdown(grid_of_interpolators(comparison));
  if (!comparison.fluctuations.empty()) {
    text += to_markdown(grid_of_fluctuations(comparison));
  }
  return text;
}

}  // namespace twin::studies::compare
