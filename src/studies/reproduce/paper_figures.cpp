#include "studies/reproduce/paper_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "pictures/figure/figure_script.hpp"
#include "pictures/figure/value_range.hpp"
#include "results/trace/trace_files.hpp"

namespace twin::studies::reproduce {
namespace {

using pictures::Album;
using pictures::Panel;
using pictures::range_of;
using pictures::ValueRange;

constexpr const char* kTime = "time [s]";
constexpr const char* kFeedrate = "feedrate [mm/s]";

std::string title_of(int number, const std::string& program, const std::string& what) {
  return fmt::format("Fig. {} (Wang & Yau): {}, {}", number, program, what);
}

/// A panel of a column over time.
Panel over_time(std::string caption, std::string y_label, const std::string& data,
                std::string_view column, int style, int height) {
  return {std::move(caption),
          kTime,
          std::move(y_label),
          "",
          fmt::format("'{}.csv' using 't_s':'{}' with lines linestyle {}", data, column, style),
          height};
}

/// Figs. 12, 13.
Expected<void> add_contour(Album& album, int number, const Answer& answer) {
  const std::string& program = answer.published.program;
  const std::string name = fmt::format("fig{}_{}", number, program);
  TWIN_TRY(const results::Table table,
           album.copy_data(results::find_trace(answer.folder), name,
                           std::array<std::string_view, 4>{"t_s", "x_cmd_mm", "y_cmd_mm",
                                                           "feedrate_mm_per_s"}));
  album.add(name, title_of(number, program, "contour, feedrate"),
            contour_panels(table, name, answer.published.feedrate_mm_per_min / 60.0));
  return {};
}

/// Figs. 14, 15.
Expected<void> add_feedrates(Album& album, int number, const std::string& program,
                             const Variant& variant) {
  const std::string name = fmt::format("fig{}_{}", number, program);
  std::vector<Panel> panels;
  for (const double feedrate : {3000.0, 2000.0, 1000.0}) {
    const Answer* answer = find_answer(variant, program, "nurbs", feedrate);
    if (answer == nullptr) {
      continue;
    }
    const std::string data = fmt::format("{}_{:.0f}", name, feedrate);
    TWIN_CHECK(album.copy_data(results::find_trace(answer->folder), data,
                               std::array<std::string_view, 2>{"t_s", "feedrate_mm_per_s"}));
    panels.push_back(
        over_time(fmt::format("({}) {:.0f},000 mm/min", "abc"[panels.size()], feedrate / 1000.0),
                  kFeedrate, data, "feedrate_mm_per_s", 1, 230));
    panels.back().settings = pictures::feedrate_axis(feedrate / 60.0);
  }
  album.add(name, title_of(number, program, "feedrate profiles"), panels);
  return {};
}

/// Figs. 16, 17.
Expected<void> add_errors(Album& album, int number, const Answer& answer) {
  const std::string& program = answer.published.program;
  const std::string name = fmt::format("fig{}_{}", number, program);
  TWIN_TRY(const results::Table table,
           album.copy_data(
               results::find_trace(answer.folder), name,
               std::array<std::string_view, 4>{"t_s", "contour_error_um", "x_tracking_error_um",
                                               "y_tracking_error_um"}));
  std::vector<Panel> panels{over_time("(a) contour errors, NURBS at 3,000 mm/min",
                                      "contour error [µm]", name, "contour_error_um", 1, 270),
                            over_time("(b) tracking errors, X axis", "error of X [µm]", name,
                                      "x_tracking_error_um", 2, 250),
                            over_time("(b) tracking errors, Y axis", "error of Y [µm]", name,
                                      "y_tracking_error_um", 3, 250)};
  const ValueRange x = range_of(table, 2);
  const ValueRange y = range_of(table, 3);
  panels[0].settings = pictures::y_axis(range_of(table, 1));
  panels[1].settings = pictures::y_axis({std::min(x.low, y.low), std::max(x.high, y.high)});
  panels[2].settings = panels[1].settings;
  album.add(name, title_of(number, program, "measured errors"), panels);
  return {};
}

/// Figs. 18, 19.
Expected<void> add_bezier(Album& album, int number, const Answer& answer) {
  const std::string& program = answer.published.program;
  const std::string name = fmt::format("fig{}_{}", number, program);
  TWIN_TRY(const results::Table table,
           album.copy_data(
               results::find_trace(answer.folder), name,
               std::array<std::string_view, 3>{"t_s", "feedrate_mm_per_s", "contour_error_um"}));
  std::vector<Panel> panels{
      over_time("(a) feedrate commands, 3,000 mm/min", kFeedrate, name, "feedrate_mm_per_s", 1,
                270),
      over_time("(b) contour errors", "contour error [µm]", name, "contour_error_um", 1, 270)};
  panels[0].settings = pictures::feedrate_axis(answer.published.feedrate_mm_per_min / 60.0);
  panels[1].settings = pictures::y_axis(range_of(table, 2));
  album.add(name, title_of(number, program, "Fast Bezier"), panels);
  return {};
}

Expected<void> add_program(Album& album, const Variant& variant, const std::string& program,
                           int first) {
  const Answer* nurbs = find_answer(variant, program, "nurbs", 3000.0);
  const Answer* bezier = find_answer(variant, program, "bezier", 3000.0);
  if (nurbs != nullptr) {
    TWIN_CHECK(add_contour(album, first, *nurbs));
    TWIN_CHECK(add_feedrates(album, first + 2, program, variant));
    TWIN_CHECK(add_errors(album, first + 4, *nurbs));
  }
  if (bezier != nullptr) {
    TWIN_CHECK(add_bezier(album, first + 6, *bezier));
  }
  return {};
}

}  // namespace

Expected<std::vector<pictures::Picture>> draw_figures(const Reproduction& reproduction,
                                                      const std::filesystem::path& folder) {
  TWIN_TRY(Album album, Album::open(folder));
  const Variant& variant = reproduction.as_published();
  TWIN_CHECK(add_program(album, variant, "oxalis", 12));
  TWIN_CHECK(add_program(album, variant, "dolphin", 13));
  return album.draw();
}

}  // namespace twin::studies::reproduce
