#include "feedrate/bound/jerk_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace twin::feedrate {
namespace {

/// A valley is as deep as this, or it is none [-]. Each anchor lets the acceleration be up to a cell
/// better than it can be, so shallow valleys give away more than they bring.
constexpr double kDeep = 1.02;
/// Places of a valley that are this little above its lowest one may be its ends [-].
constexpr double kLow = 1.005;
/// No feedrate between the ends of a valley is above this share of the lowest one [-]: it would be
/// kDeep above one that is at most kLow above the lowest.
constexpr double kBetweenLows = 1.03;
/// Most places of a valley that are kept. Of more those in the middle are left out.
constexpr std::size_t kMostLows = 64;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Width of the narrowest cell, in the time that the acceleration takes through it with J [s]. It
/// trades time for sharpness: up to half of it is lost at each anchor, and half of it makes twice as
/// many cells.
constexpr double kCell = 1e-4;

/// The same at the end of a leg that is too short for its highest feedrate, as a share of the range.
/// Such a leg takes a search for each pair of cells.
constexpr double kShortCell = 0.3;

/// Borders of the cells of the feedrate there, as shares of the highest one. With one cell alone a leg
/// could end slower than the next one begins.
constexpr std::array<double, 3> kShortFeedrates = {1.0, 0.95, 0.8};

/// Borders of the cells of the acceleration, from 0 up. They are wide where it is large: there a leg
/// loses about a^2 / (2 J sqrt(J F)) more than it can gain.
std::vector<double> positive_borders(double most, double narrowest, double cap, double jerk) {
  std::vector<double> borders{0.5 * std::min(narrowest, most)};
  while (borders.back() < most) {
    const double a = borders.back();
    borders.push_back(
        std::min(most, a + std::max(narrowest, 0.25 * a * a / std::sqrt(jerk * cap))));
  }
  return borders;
}

}  // namespace

/// Cells of the motion at an anchor.
/// @param cap       highest feedrate on the leg to it [mm/s]
/// @param is_short  the leg is too short to reach it
std::vector<JerkBound::Cell> JerkBound::cells_at(double v, double cap, bool is_short,
                                                 const RampLimits& ramp) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < (is_short ? kShortFeedrates.size() : 1); ++i) {
    const double high = kShortFeedrates[i] * v;
    const double most = std::min(ramp.acceleration, std::sqrt(2.0 * ramp.jerk * high));
    const double narrowest = std::max(kCell * ramp.jerk, is_short ? kShortCell * most : 0.0);
    const std::vector<double> borders = positive_borders(most, narrowest, cap, ramp.jerk);
    for (std::size_t k = borders.size(); k-- > 1;) {
      cells.push_back({high, -borders[k], -borders[k - 1], kNever});
    }
    cells.push_back({high, -borders[0], borders[0], kNever});
    for (std::size_t k = 1; k < borders.size(); ++k) {
      cells.push_back({high, borders[k - 1], borders[k], kNever});
    }
  }
  return cells;
}

void JerkBound::add(double s, double v, double time) {
  last_ = {s, v, last_.time + time};
  if (cells_.empty()) {
    anchor_ = last_;
    cells_.push_back({v, 0.0, 0.0, 0.0});
    peak_ = v;
    return;
  }
  if (is_falling_ && v > kDeep * std::max(lows_.back().v, lows_.front().v)) {
    take_valley();
  }
  if (!is_falling_) {
    peak_ = std::max(peak_, v);
    is_falling_ = kDeep * v < peak_;
  }
  if (is_falling_) {
    if (!lows_.empty() && v * kLow < lows_.back().v) {
      lows_.clear();
    }
    std::erase_if(lows_, [&](const Place& low) { return low.v > kLow * v; });
    lows_.push_back(last_);
    if (lows_.size() > kMostLows) {
      lows_.erase(lows_.begin() + kMostLows / 2);
    }
  }
}

/// Ends legs at both ends of the valley that was left.
void JerkBound::take_valley() {
  const auto lowest = std::min_element(lows_.begin(), lows_.end(),
                                       [](const Place& a, const Place& b) { return a.v < b.v; });
  const double low = lowest->v;
  const Place first = lows_.front();
  const auto last = std::find_if(lows_.rbegin(), lows_.rend(),
                                 [&](const Place& place) { return place.v <= kLow * low; });
  pass_leg(first, peak_);
  if (last->s > first.s) {
    pass_leg(*last, kBetweenLows * low, true);
  }
  peak_ = kBetweenLows * low;
  lows_.clear();
  is_falling_ = false;
}

/// Goes on from the anchor to the next one, which becomes the anchor.
/// @param is_valley  the leg is the bottom of a valley, and has the cells of the leg before
void JerkBound::pass_leg(const Place& to, double cap, bool is_valley) {
  const double length = to.s - anchor_.s;
  const double least = to.time - anchor_.time;
  cap = std::max({cap, anchor_.v, to.v});
  const double ramps = ramp_distance(anchor_.v, cap, ramp_) + ramp_distance(to.v, cap, ramp_);
  if (!is_valley) {
    is_short_ = ramps > length;
  }
  std::vector<Cell> next = cells_at(to.v, cap, is_short_, ramp_);
  std::vector<LegSide> sides(cells_.size());
  for (std::size_t m = 0; m < cells_.size(); ++m) {
    sides[m] = leg_side({cells_[m].v, cells_[m].most, cells_[m].least}, cap, ramp_);
  }
  for (Cell& cell : next) {
    const LegEnd end{cell.v, -cell.least, -cell.most};
    const LegSide side = leg_side(end, cap, ramp_);
    for (std::size_t m = 0; m < cells_.size(); ++m) {
      const Cell& from = cells_[m];
      const double hold = length - sides[m].distance - side.distance;
      const double time =
          hold >= 0.0 ? sides[m].time + side.time + hold / cap
                      : shortest_time(length, cap, {from.v, from.most, from.least}, end, ramp_);
      cell.cost = std::min(cell.cost, from.cost + std::max(time, least));
    }
  }
  cells_ = std::move(next);
  anchor_ = to;
}

double JerkBound::finish() {
  if (cells_.empty()) {
    return 0.0;
  }
  if (last_.s > anchor_.s) {
    pass_leg(last_, std::max(peak_, last_.v));
  }
  return std::min_element(cells_.begin(), cells_.end(),
                          [](const Cell& a, const Cell& b) { return a.cost < b.cost; })
      ->cost;
}

}  // namespace twin::feedrate
