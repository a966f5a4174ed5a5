#include "studies/reproduce/paper_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pictures/figure/value_range.hpp"
#include "studies/reproduce/sensitive_corners.hpp"

namespace twin::studies::reproduce {
namespace {

using pictures::feedrate_axis;
using pictures::kPanelWidth;
using pictures::Panel;

constexpr double kDrop = 0.15;      // of the programmed feedrate, by which a corner shows [-]
constexpr double kOnePlace = 0.02;  // of the path's extent: corners that share a letter [-]

std::vector<Moment> moments_of(const results::Table& table) {
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
      return (sign.corner.point - corners[i].point).norm() < kOnePlace * extent;
    });
    if (same != signs.end()) {
      same->text += ", " + corner_letter(i);
    } else {
      signs.push_back({corner_letter(i), corners[i]});
    }
  }
  return signs;
}

/// Letters beside the contour, clear of it and of each other.
class SignPlaces {
 public:
  SignPlaces(const std::vector<Moment>& motion, const std::vector<Moment>& corners, double extent)
      : corners_(corners), extent_(extent) {
    for (const Moment& moment : motion) {
      if (taken_.empty() || (moment.point - taken_.back()).norm() > 0.01 * extent) {
        taken_.push_back(moment.point);
      }
    }
  }

  /// The place around a corner with the most room.
  Vec2 place(const Sign& sign) {
    constexpr int kDirections = 32;
    const double half_width = 0.014 * extent_ * static_cast<double>(sign.text.size() - 1);
    Vec2 best = sign.corner.point;
    double most = -1.0;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kDirections;
      Vec2 at = sign.corner.point + 0.062 * extent_ * Vec2(std::cos(angle), std::sin(angle));
      at.x() += std::cos(angle) * half_width;
      const double room = std::min(clearance(at, half_width), 0.5 * from_others(at, sign.corner));
      if (room > most * 1.02) {
        most = room;
        best = at;
      }
    }
    taken_.push_back(best);
    return best;
  }

 private:
  /// Distance of a text of some width from what is there.
  double clearance(const Vec2& at, double half_width) const {
    double least = HUGE_VAL;
    for (const Vec2& other : taken_) {
      const Vec2 apart = other - at;
      const double beside = std::max(0.0, std::abs(apart.x()) - half_width);
      least = std::min(least, std::hypot(beside, apart.y()));
    }
    return least;
  }

  /// Distance from the other corners: a letter has to be nearest to its own.
  double from_others(const Vec2& at, const Moment& own) const {
    double least = HUGE_VAL;
    for (const Moment& corner : corners_) {
      if ((corner.point - own.point).norm() >= kOnePlace * extent_) {
        least = std::min(least, (corner.point - at).norm());
      }
    }
    return least;
  }

  const std::vector<Moment>& corners_;
  double extent_;
  std::vector<Vec2> taken_;
};

std::string contour_sign(const Sign& sign, const Vec2& at, double extent) {
  const Vec2& place = sign.corner.point;
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
  Panel panel{"(a) contour, feedrate-sensitive corners",
              "x [mm]",
              "y [mm]",
              "",
              fmt::format("'{}.csv' using 'x_cmd_mm':'y_cmd_mm' with lines linestyle 1", data),
              static_cast<int>(height)};
  panel.settings = fmt::format(
      "  set size ratio -1\n  set xrange [{:.3f}:{:.3f}]\n"
      "  set yrange [{:.3f}:{:.3f}]\n",
      low.x(), high.x(), low.y(), high.y());
  SignPlaces places(motion, corners, extent);
  for (const Sign& sign : signs_of(corners, extent)) {
    panel.settings += contour_sign(sign, places.place(sign), extent);
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
  panel.settings += fmt::format("  set xrange [{:.3f}:{:.3f}]\n", window.begin, window.end) +
                    feedrate_axis(feedrate, pictures::Letters::kBelow);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Moment& corner = corners[i];
    if (corner.t < window.begin || corner.t > window.end) {
      continue;
    }
    panel.settings += fmt::format("  set label '{}' at {:.3f}, {:.3f} center front\n",
                                  corner_letter(i), corner.t, corner.feedrate - 0.1 * feedrate);
  }
  return panel;
}

}  // namespace

std::vector<pictures::Panel> contour_panels(const results::Table& table, const std::string& data,
                                            double feedrate) {
  const std::vector<Moment> motion = moments_of(table);
  if (motion.empty()) {
    return {};
  }
  const std::vector<Moment> corners = sensitive_corners(motion, kDrop * feedrate);
  const Window all{motion.front().t, motion.back().t};
  const double duration = 0.12 * (all.end - all.begin);
  const Window violent = most_violent(motion, duration);
  const Window part{violent.begin - 0.05 * duration, violent.end + 0.05 * duration};
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

}  // namespace twin::studies::reproduce
