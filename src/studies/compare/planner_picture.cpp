#include "studies/compare/comparison_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "pictures/figure/value_range.hpp"

namespace twin::studies::compare {
namespace {

using pictures::Album;
using pictures::Panel;

constexpr std::size_t kPoints = 1500;         // of the curves of feedrate
constexpr std::size_t kLostTimePieces = 600;  // of the curves of lost time
constexpr std::size_t kCloseUp = 24;          // of them are looked at closely
constexpr std::size_t kSteep = 6;             // of them among which most is lost
constexpr const char* kBoundColour = "#F2E2B8";
constexpr std::array<std::string_view, 2> kFeedrateColumns{"s_mm", "feedrate_mm_per_s"};
constexpr std::array<std::string_view, 2> kLostColumns{"s_mm", "lost_s"};

/// Part of the path [mm].
struct Stretch {
  double begin;
  double end;
};

/// The rows of a profile between two places and those next to them.
results::Table part_of(const results::Table& profile, const Stretch& stretch) {
  results::Table part{profile.columns, {}};
  for (std::size_t i = 0; i < profile.rows(); ++i) {
    if (profile.at(std::min(i + 1, profile.rows() - 1), 0) >= stretch.begin &&
        profile.at(i == 0 ? 0 : i - 1, 0) <= stretch.end) {
      const auto row = profile.row(i);
      part.values.insert(part.values.end(), row.begin(), row.end());
    }
  }
  return part;
}

/// The stretch in whose middle a curve of lost time rises most.
Stretch worst_stretch(const results::Table& lost) {
  const std::size_t last = lost.rows() - 1;
  std::size_t worst = 0;
  for (std::size_t i = 0; i + kSteep <= last; ++i) {
    const auto rise = [&](std::size_t at) { return lost.at(at + kSteep, 1) - lost.at(at, 1); };
    worst = rise(i) > rise(worst) ? i : worst;
  }
  const std::size_t around = (kCloseUp - kSteep) / 2;
  const std::size_t begin = std::min(worst > around ? worst - around : 0, last - kCloseUp);
  return {lost.at(begin, 0), lost.at(begin + kCloseUp, 0)};
}

/// Feedrate of a contestant over its bound's, which is filled.
Expected<Panel> feedrate_panel(const Album& album, const Contestant& contestant, int style,
                               const std::string& caption, const std::string& suffix,
                               const Stretch& stretch, double fastest) {
  const std::string planned = "path_" + contestant.name + suffix;
  const std::string bound = "bound_" + contestant.name + suffix;
  const std::pair<const std::string&, const results::Table&> data[] = {
      {planned, contestant.plan.planned}, {bound, contestant.plan.bound}};
  for (const auto& [name, profile] : data) {
    TWIN_CHECK(
        album.write_data(name, kFeedrateColumns, thinned(part_of(profile, stretch), kPoints)));
  }
  const std::string axes = fmt::format("  set xrange [{:.4f}:{:.4f}]\n{}", stretch.begin,
                                       stretch.end, pictures::feedrate_axis(fastest));
  const std::string plot = fmt::format(
      "'{0}.csv' using 's_mm':'feedrate_mm_per_s' with filledcurves y1=0 fillcolor rgb '{1}', \\\n"
      "    '{2}.csv' using 's_mm':'feedrate_mm_per_s' with lines linestyle {3} linewidth 1",
      bound, kBoundColour, planned, style);
  return Panel{caption, "distance along the path [mm]", "feedrate [mm/s]", axes, plot, 250};
}

Expected<Panel> lost_panel(const Album& album, const Comparison& comparison,
                           const std::vector<results::Table>& lost) {
  std::string plot;
  double most = 0.0;
  for (std::size_t i = 0; i < lost.size(); ++i) {
    const std::string name = "lost_" + comparison.contestants[i].name;
    TWIN_CHECK(album.write_data(name, kLostColumns, lost[i]));
    most = std::max(most, pictures::range_of(lost[i], 1).high);
    plot += fmt::format("{}'{}.csv' using 's_mm':'lost_s' with lines linestyle {} linewidth 1.5",
                        i == 0 ? "" : ", \\\n    ", name, i + 1);
  }
  return Panel{"(e) time lost to the bound",
               "distance along the path [mm]",
               "time lost [s]",
               pictures::y_axis({0.0, std::max(most, 1e-3)}),
               plot,
               250};
}

}  // namespace

Expected<void> add_planner_figure(Album& album, const Comparison& comparison) {
  std::vector<results::Table> lost;
  std::vector<std::string> legend;
  double fastest = 0.0;
  for (const Contestant& contestant : comparison.contestants) {
    lost.push_back(lost_time(contestant.plan, kLostTimePieces));
    legend.push_back(contestant.name);
    fastest = std::max(fastest, pictures::range_of(contestant.plan.bound, 1).high);
  }
  std::vector<Panel> panels;
  const Stretch close = worst_stretch(lost.front());
  for (std::size_t i = 0; i < comparison.contestants.size(); ++i) {
    const Contestant& contestant = comparison.contestants[i];
    if (contestant.name != "nurbs" && contestant.name != "certified") {
      continue;
    }
    const results::Table& bound = contestant.plan.bound;
    const Stretch whole{0.0, bound.at(bound.rows() - 1, 0)};
    for (const bool is_whole : {true, false}) {
      const std::string caption = fmt::format(
          "({}) {}{}", static_cast<char>('a' + panels.size()), contestant.planner,
          is_whole ? "; the bound is filled" : ", where the paper's planner loses most");
      TWIN_TRY(Panel panel,
               feedrate_panel(album, contestant, static_cast<int>(i) + 1, caption,
                              is_whole ? "" : "_close", is_whole ? whole : close, fastest));
      panels.push_back(std::move(panel));
    }
  }
  TWIN_TRY(Panel panel, lost_panel(album, comparison, lost));
  panels.push_back(std::move(panel));
  album.add("planners", comparison.program + ", planners and the lower bound of the time", panels,
            legend);
  return {};
}

}  // namespace twin::studies::compare
