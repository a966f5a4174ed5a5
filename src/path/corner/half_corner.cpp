#include "path/corner/half_corner.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace twin::path {
namespace {

constexpr int kPieces = static_cast<int>(HalfCorner::kPieces);

/// Unknowns: the velocity along x, the place and the acceleration along y at t = 0, and the jerks.
constexpr int kUnknowns = 3 + 2 * kPieces;
constexpr int kEnds = 5;                  // conditions at t = T
constexpr int kFree = kUnknowns - kEnds;  // coordinates that the conditions leave

/// Places in each piece at which the distance from the leg is kept, counted from the first piece.
/// Acceleration is greatest in the first ones. The result is checked between the places; more of
/// them leave less to be exceeded there.
constexpr std::array<int, HalfCorner::kPieces> kPlaces{6, 5, 4, 3, 3, 3, 3, 3};

/// Shares of the tolerance that the program may use, so that it is kept between the places too: the
/// first one with which it is.
constexpr std::array<double, 2> kToleranceUsed{0.985, 0.93};

/// Share of the feedrate that it uses before the end, for the same reason, and so that a plane that
/// is stretched by half a per cent keeps it (CornerTable). It costs 0.1 % of the time.
constexpr double kFeedrateUsed = 0.999;

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

constexpr int kMostSteps = 60;          // of Newton's method, with one weight
constexpr double kLastWeight = 3000.0;  // of the way, in tolerances, against the barriers
constexpr double kWeightStep = 30.0;

using Row = Eigen::Matrix<double, 1, kUnknowns>;
using Point = Eigen::Matrix<double, kFree + 1, 1>;  // free coordinates, then the excess
using Square = Eigen::Matrix<double, kFree + 1, kFree + 1>;

/// A limit |q| <= 1 + excess, with q linear in the free coordinates.
struct Disc {
  Eigen::Matrix<double, 2, kFree> slope;
  Vec2 offset;
  bool is_strip;  // the second component is none
};

/// The convex program, in units in which the tolerance and the jerk are 1.
class HalfCornerProgram {
 public:
  HalfCornerProgram(double half_turn, double feedrate, double acceleration, double tolerance,
                    double duration)
      : cos_(std::cos(half_turn)),
        sin_(std::sin(half_turn)),
        feedrate_(feedrate),
        piece_(duration / kPieces) {
    keep_ends();
    add_limits(acceleration, tolerance);
  }

  /// Finds the solution. @returns false where there is none
  bool solve();
  Row::PlainObject unknowns() const { return (base_ + null_ * at_.head<kFree>()).transpose(); }

 private:
  Row coordinate(int axis, int derivative, double t) const;
  Row along(int derivative, double t) const {
    return cos_ * coordinate(0, derivative, t) + sin_ * coordinate(1, derivative, t);
  }
  Row across(int derivative, double t) const {
    return cos_ * coordinate(1, derivative, t) - sin_ * coordinate(0, derivative, t);
  }
  void keep_ends();
  void add_limits(double acceleration, double tolerance);
  void add(const Row& x, const Row& y, double limit);
  bool find_inside();
  double value(const Point& at, double weight) const;
  bool step(double weight, int count);

  double cos_;
  double sin_;
  double feedrate_;
  double piece_;
  Eigen::Matrix<double, kUnknowns, 1> base_;
  Eigen::Matrix<double, kUnknowns, kFree> null_;
  Eigen::Matrix<double, kFree, 1> way_;
  std::vector<Disc> discs_;
  Point at_;
};

/// A derivative of x (axis 0) or y (axis 1) at the time t, as a function of the unknowns.
Row HalfCornerProgram::coordinate(int axis, int derivative, double t) const {
  Row row = Row::Zero();
  const auto power = [](double base, int exponent) {
    return base <= 0.0     ? 0.0
           : exponent == 1 ? base
           : exponent == 2 ? 0.5 * base * base
                           : base * base * base / 6.0;
  };
  for (int i = 0; i < kPieces && derivative < 3; ++i) {
    row[3 + axis * kPieces + i] =
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
  Eigen::Matrix<double, kEnds, kUnknowns> ends;
  ends << across(0, t), coordinate(0, 1, t), coordinate(1, 1, t), coordinate(0, 2, t),
      coordinate(1, 2, t);
  Eigen::Matrix<double, kEnds, 1> wanted;
  wanted << 0.0, feedrate_ * cos_, feedrate_ * sin_, 0.0, 0.0;
  const Eigen::HouseholderQR<Eigen::Matrix<double, kUnknowns, kEnds>> qr(ends.transpose());
  const Eigen::Matrix<double, kUnknowns, kUnknowns> q = qr.householderQ();
  const Eigen::Matrix<double, kEnds, kEnds> r = qr.matrixQR().topRows<kEnds>();
  const Eigen::Matrix<double, kEnds, 1> y =
      r.triangularView<Eigen::Upper>().transpose().solve(wanted);
  base_ = q.leftCols<kEnds>() * y;
  null_ = q.rightCols<kFree>();
  way_ = (along(0, t) * null_).transpose();
}

void HalfCornerProgram::add(const Row& x, const Row& y, double limit) {
  Disc disc;
  disc.slope << x * null_ / limit, y * null_ / limit;
  disc.offset << (x * base_)(0) / limit, (y * base_)(0) / limit;
  disc.is_strip = y.isZero();
  discs_.push_back(disc);
}

void HalfCornerProgram::add_limits(double acceleration, double tolerance) {
  const Row none = Row::Zero();
  for (int i = 0; i < kPieces; ++i) {
    Row x = none;
    Row y = none;
    x[3 + i] = 1.0;
    y[3 + kPieces + i] = 1.0;
    add(x, y, 1.0);
    const double begin = piece_ * i;
    add(coordinate(0, 2, begin), coordinate(1, 2, begin), acceleration);
    const int places = kPlaces[static_cast<std::size_t>(i)];
    for (int k = 0; k < places; ++k) {
      const double t = begin + piece_ * k / places;
      add(t == 0.0 ? coordinate(1, 0, t) : across(0, t), none, tolerance);
      add(coordinate(0, 1, t), coordinate(1, 1, t), kFeedrateUsed * feedrate_);
    }
  }
}

/// Barriers of all limits, and the weight times what is to be small; infinite outside.
double HalfCornerProgram::value(const Point& at, double weight) const {
  const double reach = 1.0 + at[kFree];
  double sum = weight >= 0.0 ? -weight * way_.dot(at.head<kFree>()) : -weight * at[kFree];
  for (const Disc& disc : discs_) {
    const Vec2 q = disc.offset + disc.slope * at.head<kFree>();
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
bool HalfCornerProgram::step(double weight, int count) {
  const double reach = 1.0 + at_[kFree];
  Point slope = Point::Zero();
  Square bend = Square::Zero();
  for (const Disc& disc : discs_) {
    const Vec2 q = disc.offset + disc.slope * at_.head<kFree>();
    const double room = reach * reach - q.squaredNorm();
    Point g;
    g << disc.slope.transpose() * q * (2.0 / room), -2.0 * reach / room;
    slope += g;
    bend.noalias() += g * g.transpose();
    bend.topLeftCorner<kFree, kFree>().noalias() +=
        (2.0 / room) * disc.slope.row(0).transpose() * disc.slope.row(0);
    if (!disc.is_strip) {
      bend.topLeftCorner<kFree, kFree>().noalias() +=
          (2.0 / room) * disc.slope.row(1).transpose() * disc.slope.row(1);
    }
    bend(kFree, kFree) -= 2.0 / room;
  }
  if (weight >= 0.0) {
    slope.head<kFree>() -= weight * way_;
  } else {
    slope[kFree] -= weight;
  }
  Point move = Point::Zero();
  move.head(count) = -bend.topLeftCorner(count, count).ldlt().solve(slope.head(count));
  const double gain = -slope.dot(move);
  if (!(gain > 1e-6)) {
    return false;
  }
  const double before = value(at_, weight);
  for (double share = 1.0; share > 1e-7; share *= 0.5) {
    const Point next = at_ + share * move;
    if (value(next, weight) <= before - 0.1 * share * gain) {
      at_ = next;
      return gain > 1e-3;
    }
  }
  return false;
}

/// A point inside all limits: makes the excess as small as needed.
bool HalfCornerProgram::find_inside() {
  at_.setZero();
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

/// Fills in what is measured on the pieces. @returns whether the half keeps all limits
bool measure_half(const CornerDemand& demand, HalfCorner& half) {
  const double h = half.duration / kPieces;
  const Vec2 leg(std::cos(demand.half_turn), std::sin(demand.half_turn));
  const Vec2 normal(-leg.y(), leg.x());
  const Vec2& first = half.nodes.front().position;
  half.deviation = first.norm();
  double fastest = 0.0;
  double jerk = 0.0;
  bool is_ahead = first.y() >= 0.0;  // all of it lies beside the leg, not behind the corner
  for (const HalfCorner::Node& node : half.nodes) {
    half.deviation = std::max(half.deviation, largest_across(node, normal, h));
    half.acceleration = std::max(
        {half.acceleration, node.acceleration.norm(), (node.acceleration + h * node.jerk).norm()});
    jerk = std::max(jerk, node.jerk.norm());
    constexpr int kLooks = 16;
    for (int k = 0; k <= kLooks; ++k) {
      const double t = h * k / kLooks;
      fastest = std::max(fastest, velocity_after(node, t).norm());
      is_ahead = is_ahead && place_after(node, t).dot(leg) >= -1e-9;
    }
  }
  const double over = 1.0 + 1e-6;
  return is_ahead && half.deviation <= demand.tolerance * over &&
         fastest <= demand.feedrate * over && half.acceleration <= demand.acceleration * over &&
         jerk <= demand.jerk * over;
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
    at.jerk = Vec2(unknowns[3 + i], unknowns[3 + kPieces + i]) * (acceleration / time);
    half.nodes[static_cast<std::size_t>(i)] = at;
    at = {place_after(at, h), velocity_after(at, h), at.acceleration + h * at.jerk, at.jerk};
  }
  half.duration = h * kPieces;
  half.way = at.position.norm();
  return half;
}

}  // namespace

double half_corner_duration(const CornerDemand& demand) noexcept {
  const double build_up = demand.acceleration / demand.jerk;
  const double ramp = demand.feedrate <= demand.acceleration * build_up
                          ? std::sqrt(demand.feedrate / demand.jerk)
                          : 0.5 * (demand.feedrate / demand.acceleration + build_up);
  const double time = std::cbrt(demand.tolerance / demand.jerk);
  return std::min(
      kRampTimes * ramp + time,
      (kLeastTimes + kTimesPerTolerance * demand.feedrate * time / demand.tolerance) * time);
}

std::optional<HalfCorner> solve_half_corner(const CornerDemand& demand) {
  const double length = demand.tolerance;
  const double time = std::cbrt(demand.tolerance / demand.jerk);
  double duration = half_corner_duration(demand) / time;
  for (int i = 0; i < kDurations; ++i, duration *= kLonger) {
    for (const double used : kToleranceUsed) {
      HalfCornerProgram program(demand.half_turn, demand.feedrate * time / length,
                                demand.acceleration * time * time / length, used, duration);
      if (!program.solve()) {
        break;
      }
      HalfCorner half = half_of(program.unknowns(), length, time, duration / kPieces);
      half.feedrate = demand.feedrate;
      if (measure_half(demand, half)) {
        return half;
      }
    }
  }
  return std::nullopt;
}

}  // namespace twin::path
