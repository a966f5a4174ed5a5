#include "feedrate/certified/glide.hpp"
#include "feedrate/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {
namespace {

const Ascent kNoAscent;
constexpr std::size_t kStepsPerZone = 8;  // after which there is no plan

/// Whether a phase that rises passes a place faster than a limit.
bool is_faster_rising(const Phase& phase, double s, double limit) {
  if (phase.v > limit * (1.0 + kFeedrateRounding)) {
    return true;
  }
  if (motion_at(phase, phase.duration).v <= limit * (1.0 + kFeedrateRounding)) {
    return false;
  }
  const double gain = std::max(limit - phase.v, 0.0);
  const double root = std::sqrt(std::max(phase.a * phase.a + 2.0 * phase.j * gain, 0.0));
  const double t = gain > 0.0 ? 2.0 * gain / (phase.a + root) : 0.0;
  return motion_at(phase, t).s < s - kPlaceRounding;
}

/// The same for one that falls.
bool is_faster_falling(const Phase& phase, double s, double limit) {
  if (phase.v <= limit * (1.0 + kFeedrateRounding)) {
    return false;
  }
  if (motion_at(phase, phase.duration).v > limit * (1.0 + kFeedrateRounding)) {
    return true;
  }
  const double loss = std::max(phase.v - limit, 0.0);
  const double root = std::sqrt(std::max(phase.a * phase.a - 2.0 * phase.j * loss, 0.0));
  const double t = loss > 0.0 ? std::min(2.0 * loss / (root - phase.a), phase.duration) : 0.0;
  return motion_at(phase, t).s > s + kPlaceRounding;
}

}  // namespace

bool Glide::plan(std::span<const LimitZone> zones, const Knot& start, const Knot& end,
                 const RampLimits& ramp) {
  zones_ = zones;
  ramp_ = ramp;
  ceiling_ = std::max(start.v, end.v);
  has_zone_ramps_ = false;
  for (const LimitZone& zone : zones) {
    ceiling_ = std::max(ceiling_, zone.limit);
    has_zone_ramps_ =
        has_zone_ramps_ || zone.acceleration < ramp.acceleration || zone.jerk < ramp.jerk;
  }
  phases_.clear();
  parts_.clear();
  pending_.clear();
  free_.clear();
  for (Ascent& ascent : ascents_) {
    free_.push_back(&ascent);
  }
  const RampLimits whole = ramp_of(0, zones.size());
  pending_.push_back({start, end, ascent_from(start, Sense::kForward, 0, whole),
                      ascent_from(end, Sense::kBackward, zones.size() - 1, whole), 0, zones.size(),
                      whole});
  while (!pending_.empty()) {
    const Piece piece = pending_.back();
    pending_.pop_back();
    if (!settle(piece)) {
      return false;
    }
  }
  return true;
}

RampLimits Glide::ramp_of(std::size_t first, std::size_t last) const {
  RampLimits least = ramp_;
  for (std::size_t i = first; has_zone_ramps_ && i < last; ++i) {
    least.acceleration = std::min(least.acceleration, zones_[i].acceleration);
    least.jerk = std::min(least.jerk, zones_[i].jerk);
  }
  return least;
}

Ascent* Glide::ascent_from(const Knot& knot, Sense sense, std::size_t zone,
                           const RampLimits& ramp) {
  if (free_.empty()) {
    free_.push_back(&ascents_.emplace_back());
  }
  Ascent* ascent = free_.back();
  free_.pop_back();
  ascent->start(zones_, zone, knot, sense, ramp, ceiling_);
  return ascent;
}

void Glide::give_back(Piece& piece) {
  free_.push_back(piece.up);
  free_.push_back(piece.down);
}

bool Glide::settle(Piece piece) {
  const double length = piece.b.s - piece.a.s;
  if (piece.up == nullptr) {
    phases_.push_back({length / piece.a.v, piece.a.s, piece.a.v, 0.0, 0.0});
    return true;
  }
  if (length <= kPlaceRounding) {
    give_back(piece);
    return std::abs(piece.a.v - piece.b.v) <= 1e-6 * (1.0 + piece.a.v);
  }
  for (std::size_t i = 0; i <= kStepsPerZone * (piece.last - piece.first) + 8; ++i) {
    const bool is_joined = climb(piece);
    Violation worst{};
    if (!find_violation(piece, worst)) {
      if (is_joined) {
        parts_.push_back({phases_.size(), phases_.size() + descent_});
        phases_.insert(phases_.end(), summit_.begin(), summit_.end());
        give_back(piece);
      }
      return is_joined;
    }
    bool is_split = false;
    if (!resolve(piece, worst, is_split)) {
      return false;
    }
    if (is_split) {
      return true;
    }
  }
  return false;
}

/// Finds the summit of a piece. Where its start is too fast for that, the descent to its end is
/// taken alone: a zone that it does not keep may be a valley that can be reached.
bool Glide::climb(const Piece& piece) {
  const double v_least = std::max(piece.a.v, piece.b.v);
  Summit summit;
  const bool is_joined = join(*piece.up, *piece.down, piece.b.s - piece.a.s, v_least,
                              std::max(piece.cap, v_least), summit);
  if (!is_joined) {
    summit.v = std::min(piece.a.v, piece.down->top());
    summit.up = {0, 0.0, {0.0, summit.v, 0.0}, 0.0};
    summit.down = piece.down->exit_at(summit.v);
    summit.length = summit.down.distance;
  }
  summit_.clear();
  descent_ = append_phases(summit, is_joined ? *piece.up : kNoAscent, *piece.down,
                           piece.b.s - summit.length, piece.ramp.jerk, summit_);
  turn_ = descent_ < summit_.size() ? summit_[descent_].s : piece.b.s;
  peak_ = summit.v;
  return is_joined;
}

/// Whether the summit at hand passes a place faster than a limit.
/// @param phase  one that is not beyond the place; becomes the one with the place
bool Glide::is_faster(double s, double limit, std::size_t& phase) const {
  while (phase + 1 < summit_.size() && summit_[phase + 1].s <= s) {
    ++phase;
  }
  return phase < descent_ ? is_faster_rising(summit_[phase], s, limit)
                          : is_faster_falling(summit_[phase], s, limit);
}

/// The zone of the lowest limit that the summit at hand does not keep; of several, the middle one.
bool Glide::find_violation(const Piece& piece, Violation& worst) const {
  const std::size_t middle = piece.first + (piece.last - piece.first) / 2;
  const auto off = [&](std::size_t i) { return i > middle ? i - middle : middle - i; };
  bool is_found = false;
  std::size_t phase = 0;
  for (std::size_t i = piece.first; i < piece.last; ++i) {
    const LimitZone& zone = zones_[i];
    if (zone.limit * (1.0 + kFeedrateRounding) >= peak_) {
      continue;
    }
    if (is_found && (zone.limit > zones_[worst.zone].limit ||
                     (zone.limit == zones_[worst.zone].limit && off(i) > off(worst.zone)))) {
      continue;
    }
    const double begin = std::max(zone.begin, piece.a.s);
    const double end = std::min(zone.end, piece.b.s);
    const bool is_fast = end <= turn_     ? is_faster(end, zone.limit, phase)
                         : begin >= turn_ ? is_faster(begin, zone.limit, phase)
                                          : true;
    if (is_fast) {
      is_found = true;
      worst.zone = i;
    }
  }
  if (is_found) {
    const LimitZone& zone = zones_[worst.zone];
    const auto is_fast_at = [&](double s) {
      std::size_t at = 0;
      return s > piece.a.s + kPlaceRounding && s < piece.b.s - kPlaceRounding &&
             is_faster(s, zone.limit, at);
    };
    worst.enters = is_fast_at(zone.begin);
    worst.leaves = is_fast_at(zone.end);
  }
  return is_found;
}

bool Glide::resolve(Piece& piece, const Violation& violation, bool& is_split) {
  const LimitZone& zone = zones_[violation.zone];
  const double v = zone.limit;
  const double room_up = zone.begin - piece.a.s;
  const double room_down = piece.b.s - zone.end;
  bool is_on_way_up = violation.leaves;
  bool is_on_way_down = violation.enters;
  if (violation.enters && violation.leaves) {
    const double way_in =
        v < piece.a.v ? ramp_distance(piece.a.v, v, piece.ramp) : piece.up->exit_at(v).distance;
    const bool has_in = way_in <= room_up + kPlaceRounding;
    const bool has_out =
        v >= piece.b.v && piece.down->exit_at(v).distance <= room_down + kPlaceRounding;
    if (has_in && has_out) {
      split(piece, violation.zone);
      is_split = true;
      return true;
    }
    is_on_way_up = !has_in && (has_out || zone.end <= turn_);
    is_on_way_down = !has_out && (has_in || zone.begin >= turn_);
  }
  if (is_on_way_down && v >= piece.b.v) {
    piece.down->lower(piece.b.s - zone.begin, v);
  } else if (is_on_way_up && v >= piece.a.v) {
    piece.up->lower(zone.end - piece.a.s, v);
  } else if (v >= std::max(piece.a.v, piece.b.v)) {
    piece.cap = std::min(piece.cap, v);
  } else {
    return false;
  }
  return true;
}

void Glide::split(Piece& piece, std::size_t index) {
  const LimitZone& zone = zones_[index];
  const bool is_place = zone.end - zone.begin <= kPlaceRounding;
  const Knot in{zone.begin, zone.limit};
  const Knot out{is_place ? zone.begin : zone.end, zone.limit};
  Piece left{piece.a, in, piece.up, nullptr, piece.first, index, piece.ramp};
  Piece right{out, piece.b, nullptr, piece.down, index + 1, piece.last, piece.ramp};
  left.cap = right.cap = piece.cap;
  if (has_zone_ramps_) {
    left.ramp = ramp_of(left.first, left.last);
    right.ramp = ramp_of(right.first, right.last);
    give_back(piece);
    left.up = ascent_from(piece.a, Sense::kForward, left.first, left.ramp);
    right.down = ascent_from(piece.b, Sense::kBackward, right.last - 1, right.ramp);
  }
  left.down = ascent_from(in, Sense::kBackward, index - 1, left.ramp);
  right.up = ascent_from(out, Sense::kForward, index + 1, right.ramp);
  // Pieces are pushed last first, so that they are settled in path order.
  pending_.push_back(right);
  if (!is_place) {
    pending_.push_back({in, out, nullptr, nullptr, index, index + 1, piece.ramp});
  }
  pending_.push_back(left);
}

}  // namespace twin::feedrate
