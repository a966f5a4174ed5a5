#include "studies/compare/comparison_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/units.hpp"
#include "pictures/figure/value_range.hpp"
#include "results/trace/trace_files.hpp"
#include "studies/compare/error_curves.hpp"

namespace twin::studies::compare {
namespace {

using pictures::Album;
using pictures::Panel;

constexpr std::size_t kStretches = 250;  // of time, with the largest error of each

/// Adds a curve to what a panel draws.
void draw_curve(Panel& panel, const std::string& data, const std::string& x, const std::string& y,
                int style) {
  panel.plot += fmt::format("{}'{}.csv' using '{}':'{}' with lines linestyle {} linewidth 1",
                            panel.plot.empty() ? "" : ", \\\n    ", data, x, y, style);
}

/// Feedrates and contour errors over time.
Expected<std::vector<Panel>> curves_over_time(const Album& album, const Comparison& comparison) {
  Panel feedrate{"(a) feedrate", "time [s]", "feedrate [mm/s]", "", "", 270};
  Panel error{"(b) contour error, largest of each 1/250 of the time",
              "time [s]",
              "contour error [µm]",
              "",
              "",
              270};
  double longest = 0.0;
  double fastest = 0.0;
  double largest = 0.0;
  int style = 1;
  for (const Contestant& contestant : comparison.contestants) {
    const auto csv = results::find_trace(contestant.folder);
    const std::string name = "feedrate_" + contestant.name;
    TWIN_TRY(
        const results::Table copied,
        album.copy_data(csv, name, std::array<std::string_view, 2>{"t_s", "feedrate_mm_per_s"}));
    TWIN_TRY(const results::Table errors, read_contour_error(csv));
    const std::string error_name = "contour_error_" + contestant.name;
    const results::Table peaks = running_maximum(errors, kStretches);
    TWIN_CHECK(album.write_data(
        error_name, std::array<std::string_view, 2>{"t_s", "largest_contour_error_um"}, peaks));
    longest = std::max(longest, pictures::range_of(copied, 0).high);
    fastest = std::max(fastest, pictures::range_of(copied, 1).high);
    largest = std::max(largest, pictures::range_of(peaks, 1).high);
    draw_curve(feedrate, name, "t_s", "feedrate_mm_per_s", style);
    draw_curve(error, error_name, "t_s", "largest_contour_error_um", style);
    ++style;
  }
  const std::string whole = fmt::format("  set xrange [0:{:.3f}]\n", longest);
  feedrate.settings = whole + pictures::feedrate_axis(fastest);
  error.settings = whole + pictures::y_axis({0.0, largest});
  return std::vector<Panel>{feedrate, error};
}

/// Bars of a column of compare_bars.csv, in the colours of the curves, with their values.
std::string bars(const std::string& column, std::size_t count, const char* fill) {
  std::string plot;
  for (std::size_t i = 0; i < count; ++i) {
    plot += fmt::format(
        "{}'compare_bars.csv' using ($0 == {} ? {} : NaN):'{}' with boxes linestyle {} {} "
        "notitle",
        i == 0 ? "" : ", \\\n    ", i, i, column, i + 1, fill);
  }
  return plot;
}

std::string bar_values(const std::string& column, int decimals) {
  return fmt::format(
      ", \\\n    'compare_bars.csv' using ($0):'{0}':(sprintf('%.{1}f', column('{0}'))) with "
      "labels "
      "offset 0, 0.6 notitle",
      column, decimals);
}

Expected<std::vector<Panel>> bar_panels(const Album& album, const Comparison& comparison) {
  results::Table table{3, {}};
  std::string names;
  for (std::size_t i = 0; i < comparison.contestants.size(); ++i) {
    const Contestant& contestant = comparison.contestants[i];
    const results::MachineResults run = contestant.summary.run.value_or(results::MachineResults{});
    for (const double value : {run.machining_time, units::um_from_mm(run.contour_error.max),
                               units::um_from_mm(run.contour_error.rms)}) {
      table.values.push_back(value);
    }
    names += fmt::format("{}'{}' {}", i == 0 ? "" : ", ", contestant.name, i);
  }
  constexpr std::array<std::string_view, 3> kColumns{"machining_time_s", "contour_error_max_um",
                                                     "contour_error_rms_um"};
  TWIN_CHECK(album.write_data("compare_bars", kColumns, table));
  const std::size_t count = comparison.contestants.size();
  const auto axes = [&](std::size_t column) {
    const double top = 1.25 * pictures::range_of(table, column).high;
    return fmt::format(
        "  unset key\n  set boxwidth 0.55\n  set xrange [-0.6:{:.1f}]\n  set xtics ({})\n"
        "  set yrange [0:{:g}]\n  set ytics {:g}\n",
        static_cast<double>(count) - 0.4, names, std::max(top, 1e-9),
        pictures::tic_step({0.0, top}));
  };
  const char* const dark = "fillstyle solid 0.85 noborder";
  const char* const light = "fillstyle solid 0.3 noborder";
  Panel time{"(c) machining time",
             "",
             "time [s]",
             axes(0),
             bars("machining_time_s", count, dark) + bar_values("machining_time_s", 3),
             200};
  Panel error{"(d) contour error: max (light), RMS (dark)",
              "",
              "error [µm]",
              axes(1),
              bars("contour_error_max_um", count, light) + ", \\\n    " +
                  bars("contour_error_rms_um", count, dark) +
                  bar_values("contour_error_max_um", 1) + bar_values("contour_error_rms_um", 1),
              240};
  return std::vector<Panel>{time, error};
}

/// A panel for each program and feedrate rule, the updates laid over each other.
Expected<std::vector<Panel>> fluctuation_panels(const Album& album, const Comparison& comparison) {
  std::vector<Panel> panels;
  std::string shown;
  int style = 0;
  for (std::size_t i = 0; i < comparison.fluctuations.size(); ++i) {
    const Fluctuation& f = comparison.fluctuations[i];
    const std::string caption =
        fmt::format("({}) {}, {}", static_cast<char>('a' + panels.size()), f.program,
                    f.feedrate_rule == "constant" ? "constant feedrate" : "default feedrate rule");
    const std::string group = f.program + "|" + f.feedrate_rule;
    if (group != shown) {
      shown = group;
      style = 0;
      panels.push_back({caption, "time [s]", "fluctuation [%]",
                        "  set logscale y\n  set yrange [1e-6:1e3]\n  set ytics 100\n"
                        "  unset mytics\n  set format y '10^{%T}'\n",
                        "", 300});
    }
    TWIN_TRY(const results::Table shares,
             read_fluctuation(results::find_trace(f.folder), comparison.period));
    const std::string data = fmt::format("fluctuation_{}", i);
    TWIN_CHECK(album.write_data(
        data, std::array<std::string_view, 2>{"t_s", "largest_fluctuation_percent"},
        running_maximum(shares, kStretches)));
    draw_curve(panels.back(), data, "t_s", "largest_fluctuation_percent", ++style);
  }
  return panels;
}

}  // namespace

Expected<std::vector<pictures::Picture>> draw_figures(const Comparison& comparison,
                                                      const std::filesystem::path& folder) {
  TWIN_TRY(Album album, Album::open(folder));
  TWIN_TRY(std::vector<Panel> panels, curves_over_time(album, comparison));
  TWIN_TRY(const std::vector<Panel> bar_charts, bar_panels(album, comparison));
  TWIN_TRY(const std::vector<Panel> updates, fluctuation_panels(album, comparison));
  panels.insert(panels.end(), bar_charts.begin(), bar_charts.end());
  std::vector<std::string> names;
  for (const Contestant& contestant : comparison.contestants) {
    names.push_back(contestant.name);
  }
  album.add("compare", comparison.program + ", planners and interpolators compared", panels, names);
  TWIN_CHECK(add_planner_figure(album, comparison));
  if (!updates.empty()) {
    album.add("fluctuation", "Feedrate fluctuation under each parameter update", updates,
              {kUpdates.begin(), kUpdates.end()});
  }
  return album.draw();
}

}  // namespace twin::studies::compare
