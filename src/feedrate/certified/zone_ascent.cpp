#include "feedrate/certified/zone_ascent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// Halvings of the time of a phase: as many as it has digits, so that more would change nothing.
constexpr int kTimeHalvings = 53;

}  // namespace

void ZoneAscent::start(std::span<const LimitZone> zones, std::size_t first, const Anchor& anchor,
                       Sense sense, const RampLimits& ramp, double ceiling) {
  zones_ = zones;
  next_zone_ = first;
  count_ = sense == Sense::kForward ? zones.size() - std::min(first, zones.size())
                                    : std::min(first + 1, zones.size());
  origin_ = anchor.s;
  sign_ = static_cast<double>(sense);
  ramp_ = ramp;
  ceiling_ = std::max(ceiling, anchor.v);
  highest_ = top_ = anchor.v;
  cells_.clear();
  restart(anchor.v);
  load_cell();
}

/// Adds the next zone to the cells; after the last one they go on without end.
void ZoneAscent::load_cell() {
  while (count_ > 0) {
    const LimitZone& zone = zones_[next_zone_];
    next_zone_ += sign_ > 0.0 ? 1 : static_cast<std::size_t>(-1);
    --count_;
    const double end = sign_ * ((sign_ > 0.0 ? zone.end : zone.begin) - origin_);
    if (zone.end - zone.begin <= kTouchRounding || end <= kTouchRounding) {
      continue;
    }
    highest_ = std::max(highest_, zone.limit);
    const double most = sign_ > 0.0 ? zone.acceleration : zone.deceleration;
    const Cell cell{end, highest_, std::min(most, ramp_.acceleration),
                    std::min(zone.jerk, ramp_.jerk)};
    if (!cells_.empty() && cells_.back().limit == cell.limit &&
        cells_.back().acceleration == cell.acceleration && cells_.back().jerk == cell.jerk) {
      cells_.back().end = end;
    } else {
      cells_.push_back(cell);
    }
    return;
  }
  if (cells_.empty()) {
    cells_.push_back({kNoEnd, highest_, ramp_.acceleration, ramp_.jerk});
  }
  cells_.back().end = kNoEnd;
}

/// The cell of a place; at the end of a cell the next one.
std::size_t ZoneAscent::cell_at(double s) const noexcept {
  const auto cell =
      std::upper_bound(cells_.begin(), cells_.end(), s + kTouchRounding,
                       [](double place, const Cell& candidate) { return place < candidate.end; });
  return std::min(static_cast<std::size_t>(cell - cells_.begin()), cells_.size() - 1);
}

/// Follows a way out from cell to cell. @param take  called with each phase
template <class Take>
ZoneAscent::WayOut ZoneAscent::follow_way_out(PathMotion at, const Take& take) const noexcept {
  bool is_kept = true;
  for (std::size_t i = cell_at(at.s);; ++i) {
    const bool is_last = i + 1 >= cells_.size();
    const Cell& cell = cells_[std::min(i, cells_.size() - 1)];
    is_kept = is_kept && at.a <= cell.acceleration * (1.0 + kFeedrateRounding);
    const Phase phase{at.a / cell.jerk, at.s, at.v, at.a, -cell.jerk};
    PathMotion end = motion_at(phase, phase.duration);
    const bool ends = is_last || end.s <= cell.end;
    double time = phase.duration;
    if (!ends) {
      time = time_at(phase, cell.end);
      end = motion_at(phase, time);
      end.s = cell.end;
    }
    is_kept = is_kept && end.v <= cell.limit * (1.0 + kFormulaRounding);
    if (time > 0.0) {
      take(Phase{time, at.s, at.v, at.a, -cell.jerk});
    }
    if (ends) {
      return {end.v, end.s, is_kept, is_last && end.s > cell.end};
    }
    at = end;
  }
}

ZoneAscent::WayOut ZoneAscent::way_out(const PathMotion& at) const noexcept {
  return follow_way_out(at, [](const Phase&) {});
}

/// Whether the way out of a motion keeps all limits.
bool ZoneAscent::is_safe(const PathMotion& at) {
  WayOut way = way_out(at);
  while (way.is_beyond) {  // each turn takes a zone more, and the last has no end
    load_cell();
    way = way_out(at);
  }
  return way.is_kept;
}

void ZoneAscent::append(double duration, double jerk) {
  if (!(duration > 0.0)) {
    return;
  }
  phases_.push_back({duration, at_.s, at_.v, at_.a, jerk});
  tops_.push_back(top_);
  at_ = motion_at(phases_.back(), duration);
}

/// -J until a = 0, then no acceleration, up to the end of a cell.
void ZoneAscent::leave(const Cell& cell) {
  const Phase phase{at_.a / cell.jerk, at_.s, at_.v, at_.a, -cell.jerk};
  if (motion_at(phase, phase.duration).s > cell.end) {
    append(time_at(phase, cell.end), -cell.jerk);
    at_.s = cell.end;
    return;
  }
  append(phase.duration, -cell.jerk);
  at_.a = 0.0;
  at_.v = top_;
  hold(cell);
}

/// No acceleration up to the end of a cell, whose limit is reached but for rounding.
void ZoneAscent::hold(const Cell& cell) {
  if (at_.v >= cell.limit * (1.0 - kFeedrateRounding)) {
    top_ = at_.v = cell.limit;
  }
  if (at_.v >= ceiling_ * (1.0 - kFeedrateRounding) || cell.end == kNoEnd) {
    is_complete_ = true;
    return;
  }
  append((cell.end - at_.s) / at_.v, 0.0);
  at_.s = cell.end;
}

/// Time for which a phase may last in its cell.
double ZoneAscent::longest(const Phase& phase, const Cell& cell) const noexcept {
  double time = rising_time(phase, cell.limit);
  if (phase.j > 0.0) {
    time = std::min(time, (cell.acceleration - phase.a) / phase.j);
  }
  const Phase whole{time, phase.s, phase.v, phase.a, phase.j};
  return motion_at(whole, time).s > cell.end ? time_at(whole, cell.end) : time;
}

/// Longest time of a phase after which its way out keeps all limits; at `time` it does not.
double ZoneAscent::last_safe(const Phase& phase, double time) {
  double low = 0.0;
  for (int i = 0; i < kTimeHalvings && time - low > 1e-15 * time; ++i) {
    const double middle = 0.5 * (low + time);
    (is_safe(motion_at(phase, middle)) ? low : time) = middle;
  }
  return low;
}

void ZoneAscent::extend() {
  if (is_complete_) {
    return;
  }
  while (cells_.back().end <= at_.s + kTouchRounding) {
    load_cell();
  }
  const Cell cell = cells_[cell_at(at_.s)];
  if (at_.a <= 0.0 && at_.v >= cell.limit * (1.0 - kFeedrateRounding)) {
    hold(cell);
    return;
  }
  const bool rises = at_.a < cell.acceleration * (1.0 - kFeedrateRounding);
  const Phase phase{0.0, at_.s, at_.v, at_.a, rises ? cell.jerk : 0.0};
  double time = longest(phase, cell);
  const bool is_free = is_safe(motion_at(phase, time));
  if (!is_free) {
    time = last_safe(phase, time);
  }
  const PathMotion before = at_;
  append(time, phase.j);
  const double place = at_.s;
  if (std::abs(place - cell.end) <= kTouchRounding) {
    at_.s = cell.end;
  }
  top_ = std::max(top_, way_out(at_).v);
  const bool has_moved = place > before.s || at_.a > before.a;
  if (!is_free || !has_moved) {
    leave(cell);
  }
}

void ZoneAscent::lower(double x, double limit) {
  while (cells_.back().end < x) {
    load_cell();
  }
  const std::size_t last = cell_at(x - 2.0 * kTouchRounding);
  if (cells_[last].end > x + kTouchRounding) {
    Cell front = cells_[last];
    front.end = x;
    cells_.insert(cells_.begin() + static_cast<std::ptrdiff_t>(last), front);
  }
  bool is_lowered = false;
  for (std::size_t i = 0; i <= last; ++i) {
    is_lowered = is_lowered || cells_[i].limit > limit;
    cells_[i].limit = std::min(cells_[i].limit, limit);
  }
  if (!is_lowered) {
    return;
  }
  is_complete_ = false;
  if (top_ > limit) {
    cut_at(exit_at(limit));
    top_ = limit;
  }
}

Rise::Exit ZoneAscent::exit_at(double v) const noexcept {
  const auto above = std::lower_bound(tops_.begin(), tops_.end(), v);
  Exit exit{phases_.size(), 0.0, at_, 0.0};
  if (above != tops_.begin()) {
    exit.phase = static_cast<std::size_t>(above - tops_.begin()) - 1;
    const Phase& phase = phases_[exit.phase];
    const bool rises = phase.j > 0.0 || (phase.j == 0.0 && phase.a > 0.0);
    exit.time = phase.duration;
    const double below = way_out({phase.s, phase.v, phase.a}).v - v;
    const auto above_at = [&](double t) { return way_out(motion_at(phase, t)).v - v; };
    const double over = rises ? above_at(phase.duration) : 0.0;
    if (rises && below >= 0.0) {
      exit.time = 0.0;
    } else if (rises && over > 0.0) {
      exit.time = root_from_below(above_at, 0.0, below, phase.duration, over,
                                  {kFormulaRounding * 0.1 * v, 1e-15, 100, 3});
    }
    exit.at =
        exit.time < phase.duration || above != tops_.end() ? motion_at(phase, exit.time) : at_;
  } else if (!phases_.empty()) {
    const Phase& phase = phases_.front();
    exit = {0, 0.0, {phase.s, phase.v, phase.a}, 0.0};
  }
  exit.distance = way_out(exit.at).s;
  return exit;
}

void ZoneAscent::append_way_out(const Exit& exit, std::vector<Phase>& phases) const {
  follow_way_out(exit.at, [&](const Phase& phase) { phases.push_back(phase); });
}

}  // namespace twin::feedrate
