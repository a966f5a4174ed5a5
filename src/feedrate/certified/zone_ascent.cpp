#include "feedrate/certified/zone_ascent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// A way out touches a limit where it is below it by less than this share of it. Ten times more would
/// not be seen as touching (kFeedrateRounding), ten times less costs two ways out more.
constexpr double kTouching = 1e-10;

/// Most ways out to find where a limit is touched. Every other one halves the time that is left, so
/// that it is known to 1e-15 whatever the limits; usually a tenth of them is enough.
constexpr int kMostWaysOut = 100;

/// Time at which a phase that begins with a > 0 and -J reaches a distance, within its duration.
///
/// From the right Newton's method falls to the root, since v rises; the first guess, with a alone, is
/// on the left, and its first step leads to the right. A step of a share x of t leaves x^2 / 2 of it.
double time_along(const Phase& phase, double distance) noexcept {
  double t = 2.0 * distance / (phase.v + std::sqrt(phase.v * phase.v + 2.0 * phase.a * distance));
  for (int i = 0; i < 20; ++i) {
    // Without the place of the phase, whose rounding would never let the steps get small.
    const double way = t * (phase.v + t * (0.5 * phase.a + t * phase.j / 6.0));
    const double step = (way - distance) / (phase.v + t * (phase.a + 0.5 * t * phase.j));
    t = std::min(t - step, phase.duration);
    if (std::abs(step) <= 1e-8 * t) {
      break;
    }
  }
  return t;
}

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
  levels_.clear();
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
    const double jerk = std::min(zone.jerk, ramp_.jerk);
    if (zone.most == 0.0 && !cells_.empty() && cells_.back().limit == highest_ &&
        cells_.back().jerk == jerk && cells_.back().level + 1 == levels_.size() &&
        levels_.back().acceleration ==
            std::min(sign_ > 0.0 ? zone.acceleration : zone.deceleration, ramp_.acceleration)) {
      cells_.back().end = end;
    } else {
      cells_.push_back({end, highest_, jerk, levels_.size()});
      append_ramp_levels(zone, sign_ > 0.0 ? Sense::kForward : Sense::kBackward, ramp_, levels_);
    }
    return;
  }
  if (cells_.empty()) {
    cells_.push_back({kNoEnd, highest_, ramp_.jerk, levels_.size()});
    levels_.push_back({kNoEnd, ramp_.acceleration});
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

/// The level of a feedrate; at the top of a level the next one.
std::size_t ZoneAscent::level_at(const Cell& cell, double v) const noexcept {
  std::size_t level = cell.level;
  while (levels_[level].top <= v * (1.0 + kFeedrateRounding)) {
    ++level;
  }
  return level;
}

/// By how much -J from a motion up to a feedrate exceeds the levels of a cell, as a share of them.
double ZoneAscent::excess_over_levels(const Cell& cell, const PathMotion& at,
                                      double v_end) const noexcept {
  double a = at.a;
  double excess = -1.0;
  for (std::size_t level = level_at(cell, at.v);; ++level) {
    excess = std::max(excess, a / levels_[level].acceleration - 1.0 - kFeedrateRounding);
    const double top = levels_[level].top;
    if (top >= v_end) {
      return excess;
    }
    a = std::sqrt(std::max(at.a * at.a - 2.0 * cell.jerk * (top - at.v), 0.0));
  }
}

/// Follows a way out from cell to cell, as long as no limit is exceeded by more than a share of it.
/// @param take  called with each phase
template <class Take>
ZoneAscent::WayOut ZoneAscent::follow_way_out(PathMotion at, double most_excess,
                                              const Take& take) const noexcept {
  double excess = -1.0;
  for (std::size_t i = cell_at(at.s);; ++i) {
    const bool is_last = i + 1 >= cells_.size();
    const Cell& cell = cells_[std::min(i, cells_.size() - 1)];
    const Phase phase{at.a / cell.jerk, at.s, at.v, at.a, -cell.jerk};
    PathMotion end = motion_at(phase, phase.duration);
    const bool ends = is_last || end.s <= cell.end;
    double time = phase.duration;
    if (!ends) {
      time = time_along(phase, cell.end - at.s);
      end = motion_at(phase, time);
      end.s = cell.end;
    }
    if (is_last && end.s > cell.end) {  // what holds there is not known yet
      take(phase);
      return {end.v, end.s, excess, true};
    }
    excess = std::max(
        {excess, end.v / cell.limit - 1.0 - kFormulaRounding, excess_over_levels(cell, at, end.v)});
    if (time > 0.0) {
      take(Phase{time, at.s, at.v, at.a, -cell.jerk});
    }
    if (ends || excess > most_excess) {
      return {end.v, end.s, excess, false};
    }
    at = end;
  }
}

ZoneAscent::WayOut ZoneAscent::way_out(const PathMotion& at) const noexcept {
  return follow_way_out(at, kNoEnd, [](const Phase&) {});
}

/// By how much the way out of a motion exceeds some limit, as a share of it.
double ZoneAscent::excess_of(const PathMotion& at) {
  const auto follow = [&] { return follow_way_out(at, 0.0, [](const Phase&) {}); };
  WayOut way = follow();
  while (way.is_beyond && way.excess <= 0.0) {  // each turn takes a zone more; the last has no end
    load_cell();
    way = follow();
  }
  return way.excess;
}

void ZoneAscent::append(double duration, double jerk) {
  if (!(duration > 0.0)) {
    return;
  }
  phases_.push_back({duration, at_.s, at_.v, at_.a, jerk});
  tops_.push_back(top_);
  at_ = motion_at(phases_.back(), duration);
}

/// -J until a = 0, up to the end of a cell or of a level.
///
/// Behind the end of a cell or of a level a may be above what is allowed by the rounding of the place, which
/// a high jerk makes large. Then it comes down to what is allowed, and goes on from there.
void ZoneAscent::leave(const Cell& cell) {
  const RampLevel& level = levels_[level_at(cell, at_.v)];
  const double least = at_.a > level.acceleration ? level.acceleration : 0.0;
  Phase phase{(at_.a - least) / cell.jerk, at_.s, at_.v, at_.a, -cell.jerk};
  const double top = level.top;
  const double square = at_.a * at_.a - 2.0 * cell.jerk * (top - at_.v);
  const bool reaches_top = square > least * least;
  if (reaches_top) {
    phase.duration = std::min(phase.duration, 2.0 * (top - at_.v) / (at_.a + std::sqrt(square)));
  }
  if (motion_at(phase, phase.duration).s > cell.end) {
    append(time_at(phase, cell.end), -cell.jerk);
    at_.s = cell.end;
    return;
  }
  append(phase.duration, -cell.jerk);
  if (reaches_top) {
    at_.v = top;
    return;
  }
  at_.a = least;
  if (least > 0.0) {
    return;
  }
  at_.v = top_;
  if (at_.v >= cell.limit * (1.0 - kFeedrateRounding)) {
    hold(cell);
  }
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

/// Time for which a phase may last in its cell and level.
double ZoneAscent::longest(const Phase& phase, const Cell& cell,
                           const RampLevel& level) const noexcept {
  double time = rising_time(phase, std::min(cell.limit, level.top));
  if (phase.j > 0.0) {
    time = std::min(time, (level.acceleration - phase.a) / phase.j);
  }
  const Phase whole{time, phase.s, phase.v, phase.a, phase.j};
  return motion_at(whole, time).s > cell.end ? time_at(whole, cell.end) : time;
}

/// Longest time of a phase after which its way out keeps all limits.
/// @param time, excess  a time after which it does not, and by how much
double ZoneAscent::last_safe(const Phase& phase, double time, double excess) {
  const double now = excess_of({phase.s, phase.v, phase.a});
  if (now >= 0.0) {
    return 0.0;
  }
  const auto excess_after = [&](double t) { return excess_of(motion_at(phase, t)); };
  return root_from_below(excess_after, 0.0, now, time, excess, {kTouching, 1e-15, kMostWaysOut, 2});
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
  const RampLevel level = levels_[level_at(cell, at_.v)];
  const bool rises = at_.a < level.acceleration * (1.0 - kFeedrateRounding);
  const Phase phase{0.0, at_.s, at_.v, at_.a, rises ? cell.jerk : 0.0};
  double time = longest(phase, cell, level);
  const double excess = excess_of(motion_at(phase, time));
  const bool is_free = excess <= 0.0;
  if (!is_free) {
    time = last_safe(phase, time, excess);
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
  Exit exit{.phase = phases_.size(), .time = 0.0, .at = at_, .distance = 0.0};
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
    exit = {.phase = 0, .time = 0.0, .at = {phase.s, phase.v, phase.a}, .distance = 0.0};
  }
  exit.distance = way_out(exit.at).s;
  return exit;
}

void ZoneAscent::append_way_out(const Exit& exit, std::vector<Phase>& phases) const {
  follow_way_out(exit.at, kNoEnd, [&](const Phase& phase) { phases.push_back(phase); });
}

}  // namespace twin::feedrate
