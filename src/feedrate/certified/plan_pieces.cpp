#include "feedrate/certified/plan_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Pieces of the plan within this share of a stop's way share one place of rest. Twice as much halves
/// the work, and the supply guard of the wall clock asks for up to as much more of the path.
constexpr double kSameRest = 0.1;

/// Time of a phase at which it has a feedrate between those of its ends [s].
double time_of(const Phase& phase, double v) {
  const double gain = v - phase.v;
  const double root = std::sqrt(std::max(phase.a * phase.a + 2.0 * phase.j * gain, 0.0));
  const double rate = phase.a + std::copysign(root, gain);
  return rate != 0.0 ? std::clamp(2.0 * gain / rate, 0.0, phase.duration) : 0.0;
}

}  // namespace

void PlanPieces::find(std::span<const Phase> plan, std::span<const double> leg_ends,
                      std::span<const LimitZone> zones, const RampLimits& ramp) {
  pieces_.clear();
  plan_ = plan;
  ramp_ = ramp;
  phase_ = 0;
  if (plan_.empty()) {
    return;
  }
  auto leg = leg_ends.begin();
  double begin = plan_.front().s;
  for (const LimitZone& zone : zones) {
    if (zone.end <= std::max(zone.begin, begin + kPlaceRounding)) {
      continue;
    }
    levels_.clear();
    append_ramp_levels(zone, Sense::kBackward, ramp_, levels_);
    const double jerk = std::min(zone.jerk, ramp_.jerk);
    held_above_ = zone.held_above;
    for (; leg != leg_ends.end() && *leg <= zone.end + kPlaceRounding; ++leg) {
      add_all(begin, *leg, jerk);
      begin = *leg;
      if (!pieces_.empty() && pieces_.back().end == begin) {
        pieces_.back().a = 0.0;
        pieces_.back().ends_leg = true;
      }
    }
    if (zone.end > begin + kPlaceRounding) {
      add_all(begin, zone.end, jerk);
      begin = zone.end;
    }
  }
  plan_ = {};
}

/// Adds the pieces of a part of a zone, one for each level that the plan's feedrate has on it.
void PlanPieces::add_all(double begin, double end, double jerk) {
  if (levels_.size() == 1) {
    add(end, {levels_.front().acceleration, jerk, ramp_.profile});
    return;
  }
  std::optional<std::size_t> level;  // of what comes before
  const auto go_on_at = [&](std::size_t next, double s) {
    if (level && *level != next) {
      add(s, {levels_[*level].acceleration, jerk, ramp_.profile});
    }
    level = next;
  };
  std::size_t i = phase_;
  for (; i < plan_.size() && plan_[i].s < end; ++i) {
    const Phase& phase = plan_[i];
    const double t0 = phase.s < begin ? std::min(time_at(phase, begin), phase.duration) : 0.0;
    const double v0 = motion_at(phase, t0).v;
    const PathMotion last = motion_at(phase, phase.duration);
    const double v1 = last.s > end ? motion_at(phase, time_at(phase, end)).v : last.v;
    const auto place_of = [&](double v) { return motion_at(phase, time_of(phase, v)).s; };
    const double near = kFeedrateRounding * std::max(v0, v1);
    if (v1 >= v0) {
      std::size_t k = 0;
      for (; levels_[k].top <= v0 + near; ++k) {
      }
      go_on_at(k, std::max(phase.s, begin));
      for (; levels_[k].top < v1 - near; ++k) {
        go_on_at(k + 1, place_of(levels_[k].top));
      }
    } else {
      std::size_t k = 0;
      for (; levels_[k].top < v0 - near; ++k) {
      }
      go_on_at(k, std::max(phase.s, begin));
      for (; k > 0 && levels_[k - 1].top > v1 + near; --k) {
        go_on_at(k - 1, place_of(levels_[k - 1].top));
      }
    }
  }
  if (level) {
    add(end, {levels_[*level].acceleration, jerk, ramp_.profile});
  }
}

/// Adds a piece up to a place, or lengthens the last one where it has the same limits.
void PlanPieces::add(double end, const RampLimits& ramp) {
  const double last = pieces_.empty() ? plan_.front().s : pieces_.back().end;
  if (end <= last + kPlaceRounding) {
    return;
  }
  while (phase_ + 1 < plan_.size() && plan_[phase_ + 1].s <= end) {
    ++phase_;
  }
  const Phase& there = plan_[phase_];
  const PathMotion at = motion_at(there, std::min(time_at(there, end), there.duration));
  if (!pieces_.empty() && !pieces_.back().ends_leg &&
      pieces_.back().ramp.acceleration == ramp.acceleration &&
      pieces_.back().ramp.jerk == ramp.jerk && pieces_.back().held_above == held_above_) {
    pieces_.back().end = end;
    pieces_.back().v = at.v;
    pieces_.back().a = at.a;
    return;
  }
  pieces_.push_back({end, at.v, at.a, ramp, held_above_});
}

void PlanPieces::commit(const Anchor& start, std::vector<Stretch>& stretches) {
  std::size_t done = 0;
  for (; done < pieces_.size() && pieces_[done].end <= start.s + kPlaceRounding; ++done) {
    stretches.push_back(stretch_of(done, start.s));
  }
  // A stop that begins farther on rests farther on, so one rest may stand for several pieces.
  double from = std::numeric_limits<double>::infinity();
  double rest = from;
  for (std::size_t i = done; i-- > 0;) {
    const Piece& piece = pieces_[i];
    if (i + 1 == done || piece.end + kSameRest * (rest - from) <= from) {
      rest = rest_after(i + 1, {piece.end, piece.v, std::min(piece.a, 0.0)});
      from = piece.end;
    }
    stretches[stretches.size() - done + i].rest = rest;
  }
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(done));
  const double last = stretches.empty() ? 0.0 : stretches.back().end;
  if (!pieces_.empty() && start.s > last + kPlaceRounding) {
    stretches.push_back({.end = start.s,
                         .ramp = pieces_.front().ramp,
                         .v = start.v,
                         .rest = rest_after(0, {start.s, start.v, 0.0}),
                         .held_above = pieces_.front().held_above});
  }
}

/// A piece as a stretch of which the plan is known up to a place.
Stretch PlanPieces::stretch_of(std::size_t piece, double last) const {
  const Piece& here = pieces_[piece];
  Stretch stretch{.end = here.end, .ramp = here.ramp, .v = here.v, .held_above = here.held_above};
  if (here.a < 0.0 && here.v > 0.0) {
    stretch.fall = -here.a / (here.v * here.v);
  }
  if (piece + 1 < pieces_.size() && here.v > 0.0) {
    // A stop may take its deceleration on to the next piece, where that one allows it and is long
    // enough for it to be lost.
    const Piece& next = pieces_[piece + 1];
    stretch.is_harder_after =
        next.ramp.acceleration >= here.ramp.acceleration && next.ramp.jerk >= here.ramp.jerk &&
        std::min(next.end, last) - here.end >= here.v * here.ramp.acceleration / next.ramp.jerk;
  }
  return stretch;
}

/// Where a stop rests that begins on a piece [mm].
double PlanPieces::rest_after(std::size_t piece, PathMotion from) const {
  for (; piece < pieces_.size(); ++piece) {
    const StopPart part = make_stop_part(from, stretch_of(piece, pieces_.back().end));
    from = end_of(part.brake);
    if (part.rests) {
      break;
    }
  }
  return from.s;
}

void PlanPieces::forget(double distance) {
  for (Piece& piece : pieces_) {
    piece.end -= distance;
  }
}

}  // namespace twin::feedrate
