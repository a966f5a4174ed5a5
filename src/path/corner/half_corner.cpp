#include "path/corner/half_corner.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "path/corner/half_corner_program.hpp"

namespace twin::path {
namespace {

constexpr int kPieces = static_cast<int>(HalfCorner::kPieces);

/// Shares of the tolerance that the program may use, so that it is kept between the places too: the
/// first one with which it is.
constexpr std::array<double, 3> kToleranceUsed{0.985, 0.96, 0.93};

/// Duration of a half passage. With the time tau = (e / J)^(1/3), in which the jerk moves by the
/// tolerance, and the time R of half a ramp from rest, it is the lesser of
///   kRampTimes R + tau,   kLeastTimes tau + kTimesPerTolerance V tau^2 / e.
/// These are just above the shortest durations that exist at any turn, as found by trying many: in
/// a longer passage no less time is lost, and it needs longer legs.
constexpr double kRampTimes = 1.8;
constexpr double kLeastTimes = 1.9;
constexpr double kTimesPerTolerance = 0.29;
constexpr double kLonger = 1.12;  // the next duration that is tried
constexpr int kDurations = 4;

/// How often the program is solved anew for the jerk of the path, and the share of that which it may
/// use, so that little that changes from one solution to the next does not matter.
constexpr int kMostTurns = 8;
constexpr double kPathJerkUsed = 0.98;

using Row = HalfCornerProgram::Row;

Vec2 place_after(const HalfCorner::Node& node, double t) {
  return node.position + t * (node.velocity + t * (node.acceleration / 2.0 + t * node.jerk / 6.0));
}

Vec2 velocity_after(const HalfCorner::Node& node, double t) {
  return node.velocity + t * (node.acceleration + t * node.jerk / 2.0);
}

/// Largest |n| of a cubic n(t) within [0, h]: at an end, or where its derivative is zero.
double largest_across(const HalfCorner::Node& node, const Vec2& normal, double h) {
  const double v = node.velocity.dot(normal);
  const double a = node.acceleration.dot(normal);
  const double j = node.jerk.dot(normal);
  double largest =
      std::max(std::abs(node.position.dot(normal)), std::abs(place_after(node, h).dot(normal)));
  const double square = a * a - 2.0 * j * v;
  if (square >= 0.0) {
    const double root = a >= 0.0 ? -a - std::sqrt(square) : -a + std::sqrt(square);
    for (const double t : {root / j, 2.0 * v / root}) {
      if (t > 0.0 && t < h) {
        largest = std::max(largest, std::abs(place_after(node, t).dot(normal)));
      }
    }
  }
  return largest;
}

/// Whether acceleration and jerk of a piece keep the limits of the axes, in both halves.
bool keeps_axes(const CornerDemand& demand, const HalfCorner::Node& node, double h) {
  constexpr double kOver = 1.0 + 1e-6;
  return std::all_of(demand.axes.begin(), demand.axes.end(), [&](const CornerAxis& axis) {
    const auto most_of = [&](const Vec2& q) { return axis.part.dot(q.cwiseAbs()); };
    return (axis.jerk <= 0.0 || most_of(node.jerk) <= axis.jerk * kOver) &&
           (axis.acceleration <= 0.0 ||
            std::max(most_of(node.acceleration), most_of(node.acceleration + h * node.jerk)) <=
                axis.acceleration * kOver);
  });
}

/// Fills in what is measured on the pieces. @returns whether the half keeps all limits
bool measure_half(const CornerDemand& demand, HalfCorner& half) {
  const double h = half.duration / kPieces;
  const Vec2 leg(std::cos(demand.half_turn), std::sin(demand.half_turn));
  const Vec2 normal(-leg.y(), leg.x());
  const Vec2& first = half.nodes.front().position;
  half.deviation = first.norm();
  double fastest = 0.0;
  double jerk = 0.0;
  bool keeps = true;
  bool is_ahead = first.y() >= 0.0;  // all of it lies beside the leg, not behind the corner
  for (const HalfCorner::Node& node : half.nodes) {
    half.deviation = std::max(half.deviation, largest_across(node, normal, h));
    half.acceleration = std::max(
        {half.acceleration, node.acceleration.norm(), (node.acceleration + h * node.jerk).norm()});
    jerk = std::max(jerk, node.jerk.norm());
    keeps = keeps && keeps_axes(demand, node, h);
    constexpr int kLooks = 16;
    for (int k = 0; k <= kLooks; ++k) {
      const double t = h * k / kLooks;
      fastest = std::max(fastest, velocity_after(node, t).norm());
      is_ahead = is_ahead && place_after(node, t).dot(leg) >= -1e-9;
    }
  }
  const double over = 1.0 + 1e-6;
  return keeps && is_ahead && half.deviation <= demand.tolerance * over &&
         fastest <= demand.feedrate * over && half.acceleration <= demand.acceleration * over &&
         jerk <= demand.jerk * over;
}

/// Largest |d2v/dt2| of the feedrate [mm/s^3].
double path_jerk_of(const HalfCorner& half) {
  constexpr int kLooks = 16;
  double largest = 0.0;
  for (const HalfCorner::Node& node : half.nodes) {
    for (int k = 0; k <= kLooks; ++k) {
      const double t = half.duration / kPieces * k / kLooks;
      const Vec2 v = velocity_after(node, t);
      const Vec2 a = node.acceleration + t * node.jerk;
      const double speed = v.norm();
      const double normal = (v.x() * a.y() - v.y() * a.x()) / speed;
      largest = std::max(largest, std::abs(v.dot(node.jerk) + normal * normal) / speed);
    }
  }
  return largest;
}

/// The pieces of a solution, in mm and s.
HalfCorner half_of(const Row& unknowns, double length, double time, double piece) {
  HalfCorner half;
  HalfCorner::Node at;
  const double speed = length / time;
  const double acceleration = speed / time;
  at.position = {0.0, unknowns[1] * length};
  at.velocity = {unknowns[0] * speed, 0.0};
  at.acceleration = {0.0, unknowns[2] * acceleration};
  const double h = piece * time;
  for (int i = 0; i < kPieces; ++i) {
    at.jerk = Vec2(unknowns[static_cast<std::size_t>(3 + i)],
                   unknowns[static_cast<std::size_t>(3 + kPieces + i)]) *
              (acceleration / time);
    half.nodes[static_cast<std::size_t>(i)] = at;
    at = {place_after(at, h), velocity_after(at, h), at.acceleration + h * at.jerk, at.jerk};
  }
  half.duration = h * kPieces;
  half.way = at.position.norm();
  return half;
}

/// Goes on from a solution to one that keeps the jerk of the path. @returns false where there is none
bool keep_path_jerk(const CornerDemand& demand, double duration, Row& unknowns) {
  for (int turn = 0; demand.path_jerk > 0.0; ++turn) {
    if (path_jerk_of(half_of(unknowns, 1.0, 1.0, duration / kPieces)) <= demand.path_jerk) {
      return true;
    }
    HalfCornerProgram next(demand, duration);
    next.keep_path_jerk(unknowns, kPathJerkUsed * demand.path_jerk);
    if (turn == kMostTurns || !next.solve()) {
      return false;
    }
    unknowns = next.unknowns();
  }
  return true;
}

}  // namespace

double CornerDemand::least_acceleration() const noexcept {
  double least = acceleration;
  for (const CornerAxis& axis : axes) {
    least = axis.acceleration > 0.0 ? std::min(least, axis.acceleration) : least;
  }
  return least;
}

double CornerDemand::least_jerk() const noexcept {
  double least = path_jerk > 0.0 ? std::min(jerk, path_jerk) : jerk;
  for (const CornerAxis& axis : axes) {
    least = axis.jerk > 0.0 ? std::min(least, axis.jerk) : least;
  }
  return least;
}

double half_corner_duration(const CornerDemand& demand) noexcept {
  const double acceleration = demand.least_acceleration();
  const double jerk = demand.least_jerk();
  const double build_up = acceleration / jerk;
  const double ramp = demand.feedrate <= acceleration * build_up
                          ? std::sqrt(demand.feedrate / jerk)
                          : 0.5 * (demand.feedrate / acceleration + build_up);
  const double time = std::cbrt(demand.tolerance / jerk);
  return std::min(
      kRampTimes * ramp + time,
      (kLeastTimes + kTimesPerTolerance * demand.feedrate * time / demand.tolerance) * time);
}

std::optional<HalfCorner> solve_half_corner(const CornerDemand& demand) {
  const double length = demand.tolerance;
  const double time = std::cbrt(demand.tolerance / demand.least_jerk());
  CornerDemand scaled = demand;  // in units of that length and time
  scaled.feedrate *= time / length;
  scaled.acceleration *= time * time / length;
  scaled.jerk *= time * time * time / length;
  scaled.path_jerk *= time * time * time / length;
  for (CornerAxis& axis : scaled.axes) {
    axis.acceleration *= time * time / length;
    axis.jerk *= time * time * time / length;
  }
  double duration = half_corner_duration(demand) / time;
  for (int i = 0; i < kDurations; ++i, duration *= kLonger) {
    for (const double used : kToleranceUsed) {
      scaled.tolerance = used;
      HalfCornerProgram program(scaled, duration);
      if (!program.solve()) {
        break;
      }
      Row unknowns = program.unknowns();
      if (!keep_path_jerk(scaled, duration, unknowns)) {
        break;
      }
      HalfCorner half = half_of(unknowns, length, time, duration / kPieces);
      half.feedrate = demand.feedrate;
      if (measure_half(demand, half)) {
        return half;
      }
    }
  }
  return std::nullopt;
}

}  // namespace twin::path
