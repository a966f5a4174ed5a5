#include "reproduce/contour_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reproduce/sensitive_corners.hpp"

namespace twin::reproduce {
namespace {

constexpr double kDrop = 0.15;  // of the programmed feedrate, by which a corner shows [-]

std::vector<Moment> moments_of(const trace::Table& table) {
  std::vector<Moment> motion;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    motion.push_back({table.at(i, 0), {table.at(i, 1), table.at(i, 2)}, table.at(i, 3)});
  }
  return motion;
}

/// Where the motion is at a time.
Vec2 point_at(const std::vector<Moment>& motion, double t) {
  const auto next = std::ranges::lower_bound(motion, t, {}, &Moment::t);
  return next == motion.end() ? motion.back().point : next->point;
}

/// Letters of the corners, those at one place together.
struct Sign {
  std::string text;
  Moment corner;
};

std::vector<Sign> signs_of(const std::vector<Moment>& corners, double extent) {
  std::vector<Sign> signs;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto same = std::ranges::find_if(signs, [&](const Sign& sign) {
      return (sign.corner.point - corners[i].point).norm() < 0.02 * extent;
    });
    if (same != signs.end()) {
      same->text += ", " + corner_letter(i);
    } else {
      signs.push_back({corner_letter(i), corners[i]});
    }
  }
  return signs;
}

/// The letter beside its place on the contour, on the outer side of the bend.
std::string contour_sign(const Sign& sign, const std::vector<Moment>& motion, double extent) {
  constexpr double kAround = 0.1;  // [s]
  const Vec2& place = sign.corner.point;
  const Vec2 chord_middle =
      0.5 * (point_at(motion, sign.corner.t - kAround) + point_at(motion, sign.corner.t + kAround));
  const Vec2 outwards = (place - chord_middle).normalized();
  const Vec2 at = place + 0.055 * extent * outwards;
  return fmt::format(
      "  set label '{}' at {:.3f}, {:.3f} center front\n"
      "  set object circle at {:.3f}, {:.3f} size {:.3f} front fillstyle solid fillcolor rgb "
      "'#D55E00' linewidth 0\n",
      sign.text, at.x(), at.y(), place.x(), place.y(), 0.011 * extent);
}

/// An arrow beside the path that shows the way.
std::string direction(const std::vector<Moment>& motion, double extent, double t) {
  const Vec2 from = point_at(motion, t);
  const Vec2 way = (point_at(motion, t + 0.02) - from).normalized();
  const Vec2 to = from + 0.08 * extent * way;
  const Vec2 aside = 0.035 * extent * Vec2(-way.y(), way.x());
  return fmt::format(
      "  set arrow from {:.3f}, {:.3f} to {:.3f}, {:.3f} filled size {:.3f},20 linewidth 1.2 "
      "front\n",
      from.x() + aside.x(), from.y() + aside.y(), to.x() + aside.x(), to.y() + aside.y(),
      0.035 * extent);
}

Panel contour_panel(const std::vector<Moment>& motion, const std::vector<Moment>& corners,
                    const std::string& data) {
  Vec2 low = motion.front().point;
  Vec2 high = low;
  for (const Moment& moment : motion) {
    low = low.cwiseMin(moment.point);
    high = high.cwiseMax(moment.point);
  }
  const double extent = (high - low).maxCoeff();
  const Vec2 margin = Vec2::Constant(0.1 * extent);
  low -= margin;
  high += margin;
  const double height = std::clamp(kPanelWidth * (high - low).y() / (high - low).x(), 300.0, 800.0);
  Panel panel{"(a) contour, start of motion and feedrate-sensitive corners",
              "x [mm]",
              "y [mm]",
              "",
              fmt::format("'{}.csv' using 'x_cmd_mm':'y_cmd_mm' with lines linestyle 1", data),
              static_cast<int>(height)};
  panel.settings = fmt::format(
      "  set size ratio -1\n  set xrange [{:.3f}:{:.3f}]\n"
      "  set yrange [{:.3f}:{:.3f}]\n",
      low.x(), high.x(), low.y(), high.y());
  for (const Sign& sign : signs_of(corners, extent)) {
    panel.settings += contour_sign(sign, motion, extent);
  }
  return panel.settings += direction(motion, extent, 0.3), panel;
}

/// Feedrate over time with the letters below the corners.
Panel feedrate_panel(const std::vector<Moment>& corners, const std::string& data, double feedrate,
                     const Window& window) {
  Panel panel{"",
              "time [s]",
              "feedrate [mm/s]",
              "  set size noratio\n",
              fmt::format("'{}.csv' using 't_s':'feedrate_mm_per_s' with lines linestyle 1", data),
              270};
  panel.settings += fmt::format("  set xrange [{:.3f}:{:.3f}]\n  set yrange [0:{:.3f}]\n",
                                window.begin, window.end, 1.12 * feedrate);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Moment& corner = corners[i];
    if (corner.t < window.begin || corner.t > window.end) {
      continue;
    }
    const bool has_room = corner.feedrate > 0.2 * feedrate;
    panel.settings += fmt::format("  set label '{}' at {:.3f}, {:.3f} {} front offset {}\n",
                                  corner_letter(i), corner.t, corner.feedrate,
                                  has_room ? "center" : "left", has_room ? "0, -0.7" : "0.4, 0.3");
  }
  return panel;
}

}  // namespace

std::vector<Panel> contour_panels(const trace::Table& table, const std::string& data,
                                  double feedrate) {
  const std::vector<Moment> motion = moments_of(table);
  if (motion.empty()) {
    return {};
  }
  const std::vector<Moment> corners = sensitive_corners(motion, kDrop * feedrate);
  const Window all{motion.front().t, motion.back().t};
  const Window part = most_violent(motion, 0.12 * (all.end - all.begin));
  std::vector<Panel> panels{contour_panel(motion, corners, data),
                            feedrate_panel(corners, data, feedrate, all),
                            feedrate_panel(corners, data, feedrate, part)};
  panels[1].caption = "(b) feedrate; (c) is the shaded part";
  panels[1].settings += fmt::format(
      "  set object rectangle from {:.3f}, graph 0 to {:.3f}, graph 1 behind fillstyle solid "
      "fillcolor rgb '#F0E6CC' linewidth 0\n",
      part.begin, part.end);
  panels[2].caption = "(c) feedrate, magnified";
  return panels;
}

}  // namespace twin::reproduce
