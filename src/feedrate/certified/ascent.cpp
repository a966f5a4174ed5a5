#include "feedrate/certified/ascent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// A feedrate below this share of a limit cannot come to touch it. Nearer to 1 a step that is
/// touched might be skipped by rounding; farther from it more steps are looked at than need be.
constexpr double kBelow = 1.0 - 1e-13;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void Ascent::start(std::span<const LimitZone> zones, std::size_t first, const Anchor& anchor,
                   Sense sense, const RampLimits& ramp, double ceiling) {
  zones_ = zones;
  first_zone_ = next_zone_ = first;
  origin_ = anchor.s;
  sign_ = static_cast<double>(sense);
  a_max_ = ramp.acceleration;
  jerk_ = ramp.jerk;
  ceiling_ = std::max(ceiling, anchor.v);
  highest_ = anchor.v;
  has_all_steps_ = false;
  steps_.clear();
  step_ = 0;
  restart(anchor.v);
}

double Ascent::leaving_feedrate(const PathMotion& at) const noexcept {
  return at.v + at.a * at.a / (2.0 * jerk_);
}

double Ascent::top() const noexcept { return leaving_feedrate(at_); }

/// Adds the step that ends where the next higher limit begins. The first zone is that of the anchor, which may lie
/// before it by rounding: a rest there would have to be held up to the zone, and never be left.
bool Ascent::load_step() {
  if (has_all_steps_) {
    return false;
  }
  // Counting down from 0 gives the largest index: no zone either.
  const std::size_t next = sign_ > 0.0 ? 1 : static_cast<std::size_t>(-1);
  for (; highest_ < ceiling_ && next_zone_ < zones_.size(); next_zone_ += next) {
    const LimitZone& zone = zones_[next_zone_];
    if (zone.limit <= highest_ || zone.end - zone.begin <= kTouchRounding) {
      continue;
    }
    const double way = sign_ * ((sign_ > 0.0 ? zone.begin : zone.end) - origin_);
    steps_.push_back({next_zone_ == first_zone_ ? 0.0 : way, highest_});
    highest_ = zone.limit;
    return true;
  }
  steps_.push_back({kInfinity, highest_});
  has_all_steps_ = true;
  return true;
}

const Ascent::Step& Ascent::step(std::size_t index) {
  while (index >= steps_.size() && load_step()) {
  }
  return steps_[std::min(index, steps_.size() - 1)];
}

/// Distance at which -J from a motion reaches a limit, at.v <= limit < p [mm].
double Ascent::crossing(const PathMotion& at, double limit) const noexcept {
  const double gain = limit - at.v;
  const double root = std::sqrt(std::max(at.a * at.a - 2.0 * jerk_ * gain, 0.0));
  const double t = at.a + root > 0.0 ? 2.0 * gain / (at.a + root) : 0.0;
  return at.s + t * (at.v + t * (at.a / 2.0 - t * jerk_ / 6.0));
}

/// Whether -J after this time of a phase keeps a step.
bool Ascent::keeps(const Phase& phase, double time, const Step& step) const noexcept {
  const PathMotion at = motion_at(phase, time);
  if (leaving_feedrate(at) <= step.limit) {
    return true;
  }
  if (at.v <= step.limit) {
    return crossing(at, step.limit) >= step.end - kTouchRounding;
  }
  return motion_at(phase, rising_time(phase, step.limit)).s >= step.end - kTouchRounding;
}

/// Time of a phase after which p is a limit; negative where p is beyond it at its start.
double Ascent::longest(const Phase& phase, double limit) const noexcept {
  const double gain = limit - leaving_feedrate({phase.s, phase.v, phase.a});
  if (gain <= 0.0) {
    return gain < 0.0 ? -1.0 : 0.0;
  }
  return phase.j > 0.0 ? gain / (phase.a + std::sqrt(phase.a * phase.a + jerk_ * gain))
                       : gain / phase.a;
}

/// Largest time of a phase after which -J keeps a step that it does not keep after `time`.
double Ascent::touching(const Phase& phase, double time, const Step& step) const noexcept {
  double low = longest(phase, step.limit);
  if (low >= 0.0) {
    const PathMotion at = motion_at(phase, low);
    const double t = at.a / jerk_;
    if (at.s + t * (at.v + t * at.a / 3.0) <= step.end) {
      return low;
    }
  }
  low = std::max(low, 0.0);
  const double high = std::min(time, rising_time(phase, step.limit));
  if (!(high > low)) {
    return low;
  }
  const double rise = phase.j > 0.0 ? 2.0 * jerk_ : jerk_;  // of a, per time that -J is later
  const auto missing_at = [&](double t) {  // distance to the middle of the places that touch [mm]
    const PathMotion at = motion_at(phase, t);
    const double above = crossing(at, step.limit) - step.end;
    const double a = std::sqrt(std::max(at.a * at.a - 2.0 * jerk_ * (step.limit - at.v), 0.0));
    const double later = (at.a - a) / jerk_;
    const double slope = rise * later * (0.5 * later - (a > 0.0 ? step.limit / a : kInfinity));
    return ValueAndSlope{0.5 * kTouchRounding - above, -slope};
  };
  const NewtonRoot root =
      bracketed_newton(missing_at, low, high, high, {0.5 * kTouchRounding, 0.0, 0.0, 100});
  return root.is_met ? root.x : root.low;
}

void Ascent::append(double duration, double jerk) {
  if (!(duration > 0.0)) {
    return;
  }
  phases_.push_back({duration, at_.s, at_.v, at_.a, jerk});
  tops_.push_back(top());
  at_ = motion_at(phases_.back(), duration);
}

/// -J until a step ends or a = 0, then no acceleration until it ends.
void Ascent::follow(const Step& step) {
  if (top() > step.limit * (1.0 + kFormulaRounding)) {
    const double root =
        std::sqrt(std::max(at_.a * at_.a - 2.0 * jerk_ * (step.limit - at_.v), 0.0));
    append((at_.a - root) / jerk_, -jerk_);
    at_.s = std::max(at_.s, step.end);
    at_.v = step.limit;
    at_.a = root;
    return;
  }
  append(at_.a / jerk_, -jerk_);
  at_.a = 0.0;
  at_.v = step.limit;
  if (step.end == kInfinity) {
    is_complete_ = true;
    return;
  }
  append((step.end - at_.s) / at_.v, 0.0);
  at_ = {step.end, step.limit, 0.0};
}

void Ascent::extend() {
  if (is_complete_) {
    return;
  }
  while (step(step_).end <= at_.s + kTouchRounding) {
    ++step_;
  }
  Phase phase{0.0, at_.s, at_.v, at_.a, at_.a < a_max_ * (1.0 - kFormulaRounding) ? jerk_ : 0.0};
  double time = std::max(longest(phase, ceiling_), 0.0);
  if (phase.j > 0.0) {
    time = std::min(time, (a_max_ - at_.a) / jerk_);
  }
  const Step* binding = nullptr;
  std::size_t index = step_;
  for (std::size_t i = step_;; ++i) {
    const Step& next = step(i);
    if (leaving_feedrate(motion_at(phase, time)) < next.limit * kBelow) {
      break;
    }
    if (next.end == kInfinity || !keeps(phase, time, next)) {
      time = touching(phase, time, next);
      index = i;
      binding = &next;
    }
    if (next.end == kInfinity) {
      break;
    }
  }
  append(time, phase.j);
  if (binding != nullptr) {
    const Step touched = steps_[index];
    follow(touched);
  }
}

void Ascent::lower(double x, double limit) {
  while ((steps_.empty() || steps_.back().end < x) && load_step()) {
  }
  const auto above = std::find_if(steps_.begin(), steps_.end(),
                                  [&](const Step& step) { return step.limit > limit; });
  const auto beyond =
      std::find_if(above, steps_.end(), [&](const Step& step) { return step.end > x; });
  if (above == steps_.end()) {
    return;
  }
  const auto place = steps_.erase(above, beyond);
  steps_.insert(place, {x, limit});
  is_complete_ = false;
  if (top() > limit) {
    cut_at(exit_at(limit));
  }
  step_ = 0;
}

Rise::Exit Ascent::exit_at(double v) const noexcept {
  const auto above = std::lower_bound(tops_.begin(), tops_.end(), v);
  Exit exit{.phase = phases_.size(), .time = 0.0, .at = at_, .distance = 0.0};
  if (above != tops_.begin()) {
    exit.phase = static_cast<std::size_t>(above - tops_.begin()) - 1;
    const Phase& phase = phases_[exit.phase];
    const bool rises = phase.j > 0.0 || (phase.j == 0.0 && phase.a > 0.0);
    exit.time = rises ? std::clamp(longest(phase, v), 0.0, phase.duration) : phase.duration;
    exit.at =
        exit.time < phase.duration || above != tops_.end() ? motion_at(phase, exit.time) : at_;
  } else if (!phases_.empty()) {
    const Phase& phase = phases_.front();
    exit = {.phase = 0, .time = 0.0, .at = {phase.s, phase.v, phase.a}, .distance = 0.0};
  }
  const double t = exit.at.a / jerk_;
  exit.distance = exit.at.s + t * (exit.at.v + t * exit.at.a / 3.0);
  // Along a phase dp/dt = a (1 + j / J), and the distance grows by (v + a^2 / J) (1 + j / J).
  exit.slope = exit.at.a > 0.0 ? exit.at.v / exit.at.a + t : 0.0;
  return exit;
}

void Ascent::append_way_out(const Exit& exit, std::vector<Phase>& phases) const {
  if (exit.at.a > 0.0) {
    phases.push_back({exit.at.a / jerk_, exit.at.s, exit.at.v, exit.at.a, -jerk_});
  }
}

}  // namespace twin::feedrate
