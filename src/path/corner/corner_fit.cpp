#include "path/corner/corner_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::path {
namespace {

/// Ratio of the feedrates that are tried on short legs. They are the same for all corners, so that
/// corners share passages. With smaller steps less is lost, half of a step of the feedrate on
/// average; with twice as many, twice as many passages have to be solved.
constexpr double kFeedrateStep = 1.05;
constexpr double kLeastShare = 1e-3;  // of the programmed feedrate

constexpr double kNoPart = 1e-9;  // of a direction along an axis

/// Turns of more than this are not passed under the jerk of the path: they would lose more than a stop. It
/// saves looking for a passage, which takes a millisecond a corner. Change of direction, 0.8: 47 degrees.
constexpr double kMostTurnByPath = 0.8;

/// The largest part of the motion that each axis has.
Vec3 moves_of(const CornerLeg& before, const CornerLeg& after) {
  return before.direction.cwiseAbs().cwiseMax(after.direction.cwiseAbs());
}

/// Whether the jerk of a passage has a bound: as a vector, or by the limits of all axes that move.
bool has_bounded_jerk(const CornerLeg& before, const CornerLeg& after, const Limits& limits) {
  const Vec3 moves = moves_of(before, after);
  return limits.jerk_of == JerkOf::kVector ||
         ((moves.array() <= kNoPart) || (limits.axis_jerk.array() > 0.0)).all();
}

/// The limits of a passage: those of the path as vectors, and those of every axis that moves.
CornerDemand demand_of(const CornerLeg& before, const CornerLeg& after, double tolerance,
                       const Limits& limits) {
  CornerDemand demand;
  demand.feedrate = std::min(before.feedrate, after.feedrate);
  demand.tolerance = tolerance;
  demand.acceleration = limits.acceleration;
  demand.jerk = limits.jerk;
  const Vec3 moves = moves_of(before, after);
  if (limits.jerk_of == JerkOf::kPath) {
    demand.jerk = limits.axis_jerk.norm();  // no more, with the limits of the axes
    demand.path_jerk = limits.jerk;
  }
  for (int i = 0; i < 3; ++i) {
    if (moves[i] > kNoPart) {
      if (limits.axis_feedrate[i] > 0.0) {
        demand.feedrate = std::min(demand.feedrate, limits.axis_feedrate[i]);
      }
      CornerAxis& axis = demand.axes[static_cast<std::size_t>(i)];
      axis.acceleration = limits.axis_acceleration[i];
      axis.jerk = limits.axis_jerk[i];
    }
  }
  return demand;
}

double ramp_time(double change, const CornerDemand& demand) {
  const double acceleration = demand.least_acceleration();
  const double jerk = demand.least_jerk();
  const double build_up = acceleration / jerk;
  return change <= acceleration * build_up ? 2.0 * std::sqrt(change / jerk)
                                           : change / acceleration + build_up;
}

double ramp_way(double v, double w, const CornerDemand& demand) {
  return 0.5 * (v + w) * ramp_time(std::abs(v - w), demand);
}

/// Whether a half passage of a length has room on a leg, and leaves what a plan needs beside it.
bool has_room(const CornerLeg& leg, double way, const CornerDemand& demand) {
  return way <= kMostOfLeg * leg.length &&
         way + ramp_way(leg.passage, demand.feedrate, demand) <= leg.room;
}

/// The next lower feedrate that is tried.
double next_below(double feedrate) {
  const double place = std::log(feedrate) / std::log(kFeedrateStep);
  return std::pow(kFeedrateStep, std::ceil(place - 1e-6) - 1.0);
}

/// Share of the jerk that the feedrate in a curve uses, as feedrate/limits/axis_limits.hpp has it. It
/// decides between curve and passage, and is no limit.
constexpr double kCurveShare = 0.5;

/// Time that the curve loses beside a run at the feedrate of the demand, with the same limits [s].
/// Its third derivative is turn / h^2 and its curvature turn / h at most.
double curve_loss(double width, double turn, const CornerDemand& demand) {
  if (!(width > 0.0)) {
    return std::numeric_limits<double>::infinity();
  }
  const double v = std::min({demand.feedrate,
                             std::cbrt(kCurveShare * demand.least_jerk() * width * width / turn),
                             std::sqrt(demand.least_acceleration() * width / turn)});
  const double lost = demand.feedrate - v;
  return (lost * ramp_time(lost, demand) + 2.0 * width * lost / v) / demand.feedrate;
}

}  // namespace

std::optional<CornerMotion> fit_passage(const Vec3& corner, const CornerLeg& before,
                                        const CornerLeg& after, double tolerance, double curve,
                                        const Limits& limits, CornerTable& table,
                                        const std::function<double(double)>& other) {
  const double turn = (after.direction - before.direction).norm();
  const bool keeps_path_jerk = limits.jerk_of == JerkOf::kPath;
  if (!has_bounded_jerk(before, after, limits) || (keeps_path_jerk && turn > kMostTurnByPath)) {
    return std::nullopt;
  }
  CornerDemand demand = demand_of(before, after, tolerance, limits);
  const auto loss_without = [&] {
    return keeps_path_jerk ? other(demand.feedrate) : curve_loss(curve, turn, demand);
  };
  const double least = kLeastShare * demand.feedrate;
  for (; demand.feedrate > least; demand.feedrate = next_below(demand.feedrate)) {
    const double length = demand.feedrate * half_corner_duration(demand);
    if (length > kMostAtFeedrate * std::min(before.length, after.length) ||
        !has_room(before, 0.0, demand) || !has_room(after, 0.0, demand)) {
      continue;
    }
    const double without = loss_without();
    if (without <= 0.0) {
      return std::nullopt;
    }
    const auto passage = table.find(corner, before.direction, after.direction, demand);
    if (keeps_path_jerk && !passage) {
      return std::nullopt;
    }
    if (!passage || !has_room(before, passage->way, demand) ||
        !has_room(after, passage->way, demand)) {
      continue;
    }
    const double loss = passage->duration() - 2.0 * passage->way / passage->feedrate;
    return loss < without ? passage : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace twin::path
