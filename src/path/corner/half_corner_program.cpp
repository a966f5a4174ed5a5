#include "path/corner/half_corner_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::path {
namespace {

/// Places in each piece at which the distance from the leg is kept, counted from the first piece.
/// Acceleration is greatest in the first ones. The result is checked between the places; more of
/// them leave less to be exceeded there.
constexpr std::array<int, HalfCorner::kPieces> kPlaces{6, 5, 4, 3, 3, 3, 3, 3};

/// Share of the feedrate that it uses before the end, for the same reason, and so that a plane that
/// is stretched by half a per cent keeps it (CornerTable). It costs 0.1 % of the time.
constexpr double kFeedrateUsed = 0.999;

constexpr int kMostSteps = 60;          // of Newton's method, with one weight
constexpr double kLastWeight = 3000.0;  // of the way, in tolerances, against the barriers
constexpr double kWeightStep = 30.0;

}  // namespace

HalfCornerProgram::HalfCornerProgram(const CornerDemand& demand, double duration)
    : cos_(std::cos(demand.half_turn)),
      sin_(std::sin(demand.half_turn)),
      feedrate_(demand.feedrate),
      piece_(duration / kPieces) {
  keep_ends();
  add_limits(demand);
}

/// A derivative of x (axis 0) or y (axis 1) at the time t, as a function of the unknowns.
HalfCornerProgram::Row HalfCornerProgram::coordinate(int axis, int derivative, double t) const {
  Row row{};
  const auto power = [](double base, int exponent) {
    return base <= 0.0     ? 0.0
           : exponent == 1 ? base
           : exponent == 2 ? 0.5 * base * base
                           : base * base * base / 6.0;
  };
  for (int i = 0; i < kPieces && derivative < 3; ++i) {
    row[static_cast<std::size_t>(3 + axis * kPieces + i)] =
        power(t - piece_ * i, 3 - derivative) - power(t - piece_ * (i + 1), 3 - derivative);
  }
  if (axis == 0) {
    row[0] = derivative == 0 ? t : derivative == 1 ? 1.0 : 0.0;
    return row;
  }
  row[1] = derivative == 0 ? 1.0 : 0.0;
  row[2] = derivative == 0 ? 0.5 * t * t : derivative == 1 ? t : 1.0;
  return row;
}

/// The unknowns that end on the leg, at the feedrate, with no acceleration: a point, and directions.
void HalfCornerProgram::keep_ends() {
  const double t = piece_ * kPieces;
  const std::array<Row, kEnds> ends{across(0, t), coordinate(0, 1, t), coordinate(1, 1, t),
                                    coordinate(0, 2, t), coordinate(1, 2, t)};
  const std::array<double, kEnds> wanted{0.0, feedrate_ * cos_, feedrate_ * sin_, 0.0, 0.0};
  std::array<Row, kEnds> normal;
  for (std::size_t i = 0; i < kEnds; ++i) {
    Row row = ends[i];
    make_orthogonal(row, normal, i);
    const double length = std::sqrt(product(row, row));
    normal[i] = {};
    add_to(normal[i], 1.0 / length, row);
    // The part along this row is the last that the i-th end depends on.
    add_to(base_, (wanted[i] - product(ends[i], base_)) / length, normal[i]);
  }
  for (std::size_t i = 0; i < kFree; ++i) {
    Row best{};
    double longest = 0.0;
    for (std::size_t k = 0; k < kUnknowns; ++k) {
      Row row{};
      row[k] = 1.0;
      make_orthogonal(row, normal, kEnds);
      make_orthogonal(row, null_, i);
      if (const double length = std::sqrt(product(row, row)); length > longest) {
        longest = length;
        best = row;
      }
    }
    add_to(null_[i], 1.0 / longest, best);
  }
  way_ = of_free(along(0, t), 1.0);
}

void HalfCornerProgram::add(const Row& x, const Row& y, double limit) {
  discs_.push_back({{of_free(x, 1.0 / limit), of_free(y, 1.0 / limit)},
                    Vec2(product(x, base_) / limit, product(y, base_) / limit),
                    y == Row{}});
}

/// Keeps a vector within the limits of the axes, in this half and in its mirror image. An axis whose
/// limit no vector within `most` exceeds is left out.
void HalfCornerProgram::add_axes(const CornerDemand& demand, double CornerAxis::*limit,
                                 const Row& x, const Row& y, double most) {
  for (const CornerAxis& axis : demand.axes) {
    if (!(axis.*limit > 0.0) || axis.part.norm() * most <= axis.*limit) {
      continue;
    }
    const bool has_both = axis.part.x() > 0.0 && axis.part.y() > 0.0;
    for (const double sign : {1.0, -1.0}) {
      if (sign > 0.0 || has_both) {
        Row row{};
        add_to(row, axis.part.x(), x);
        add_to(row, sign * axis.part.y(), y);
        add(row, Row{}, axis.*limit);
      }
    }
  }
}

void HalfCornerProgram::add_limits(const CornerDemand& demand) {
  const Row none{};
  for (int i = 0; i < kPieces; ++i) {
    Row x = none;
    Row y = none;
    x[static_cast<std::size_t>(3 + i)] = 1.0;
    y[static_cast<std::size_t>(3 + kPieces + i)] = 1.0;
    add(x, y, demand.jerk);
    add_axes(demand, &CornerAxis::jerk, x, y, demand.jerk);
    const double begin = piece_ * i;
    const Row ax = coordinate(0, 2, begin);
    const Row ay = coordinate(1, 2, begin);
    add(ax, ay, demand.acceleration);
    add_axes(demand, &CornerAxis::acceleration, ax, ay, demand.acceleration);
    const int places = kPlaces[static_cast<std::size_t>(i)];
    for (int k = 0; k < places; ++k) {
      const double t = begin + piece_ * k / places;
      add(t == 0.0 ? coordinate(1, 0, t) : across(0, t), none, demand.tolerance);
      add(coordinate(0, 1, t), coordinate(1, 1, t), kFeedrateUsed * feedrate_);
    }
  }
}

void HalfCornerProgram::keep_path_jerk(const Row& other, double limit) {
  constexpr int kLooks = 4;
  for (int i = 0; i < kPieces; ++i) {
    for (int k = 0; k <= kLooks; ++k) {
      const double t = piece_ * (i + static_cast<double>(k) / kLooks);
      const Vec2 v(product(coordinate(0, 1, t), other), product(coordinate(1, 1, t), other));
      const Vec2 a(product(coordinate(0, 2, t), other), product(coordinate(1, 2, t), other));
      const double speed = v.norm();
      const double normal = (v.x() * a.y() - v.y() * a.x()) / speed;
      Row along{};
      along[static_cast<std::size_t>(3 + i)] = v.x() / speed;
      along[static_cast<std::size_t>(3 + kPieces + i)] = v.y() / speed;
      add(along, Row{}, limit);
      discs_.back().offset.x() += normal * normal / speed / limit;
    }
  }
}

/// Barriers of all limits, and the weight times what is to be small; infinite outside.
double HalfCornerProgram::value(const Point& at, double weight) const {
  const double reach = 1.0 + at[kFree];
  double sum = weight >= 0.0 ? -weight * product(way_, at) : -weight * at[kFree];
  for (const Disc& disc : discs_) {
    const Vec2 q = disc.at(at);
    const double room = reach * reach - q.squaredNorm();
    if (!(room > 0.0) || !(reach > 0.0)) {
      return std::numeric_limits<double>::infinity();
    }
    sum -= std::log(room);
  }
  return sum;
}

/// One step of Newton's method in the first `count` coordinates. A negative weight counts for the
/// excess, a positive one for the way. @returns false where nothing is gained any more
bool HalfCornerProgram::step(double weight, std::size_t count) {
  const double reach = 1.0 + at_[kFree];
  Point slope{};
  Square bend{};
  for (const Disc& disc : discs_) {
    const Vec2 q = disc.at(at_);
    const double room = reach * reach - q.squaredNorm();
    Point g{};
    add_to(g, 2.0 * q.x() / room, disc.slope[0]);
    add_to(g, 2.0 * q.y() / room, disc.slope[1]);
    g[kFree] = -2.0 * reach / room;
    add_to(slope, 1.0, g);
    for (std::size_t i = 0; i <= kFree; ++i) {
      add_to(bend[i], g[i], g);
    }
    for (std::size_t i = 0; i < kFree; ++i) {
      add_to(bend[i], 2.0 / room * disc.slope[0][i], disc.slope[0]);
      if (!disc.is_strip) {
        add_to(bend[i], 2.0 / room * disc.slope[1][i], disc.slope[1]);
      }
    }
    bend[kFree][kFree] -= 2.0 / room;
  }
  if (weight >= 0.0) {
    add_to(slope, -weight, way_);
  } else {
    slope[kFree] -= weight;
  }
  Point move{};
  std::copy_n(slope.begin(), count, move.begin());
  if (!solve_in_place(bend, move, count)) {
    return false;
  }
  const double gain = product(slope, move);
  if (!(gain > 1e-6)) {
    return false;
  }
  const double before = value(at_, weight);
  for (double share = 1.0; share > 1e-7; share *= 0.5) {
    Point next = at_;
    add_to(next, -share, move);
    if (value(next, weight) <= before - 0.1 * share * gain) {
      at_ = next;
      return gain > 1e-3;
    }
  }
  return false;
}

/// A point inside all limits: makes the excess as small as needed.
bool HalfCornerProgram::find_inside() {
  at_ = {};
  double worst = 0.0;
  for (const Disc& disc : discs_) {
    worst = std::max(worst, disc.offset.norm());
  }
  at_[kFree] = 1.1 * worst;
  for (double weight = 1.0; weight < 1e6; weight *= kWeightStep) {
    for (int i = 0; i < kMostSteps && at_[kFree] > -0.02 && step(-weight, kFree + 1); ++i) {
    }
    if (at_[kFree] < -1e-3) {
      break;
    }
  }
  const bool is_inside = at_[kFree] < 0.0;
  at_[kFree] = 0.0;
  return is_inside;
}

bool HalfCornerProgram::solve() {
  if (!find_inside()) {
    return false;
  }
  for (double weight = 1.0; weight < kLastWeight; weight *= kWeightStep) {
    for (int i = 0; i < kMostSteps && step(weight, kFree); ++i) {
    }
  }
  return true;
}

}  // namespace twin::path
