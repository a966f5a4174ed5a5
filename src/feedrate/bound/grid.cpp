#include "feedrate/bound/grid.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {
namespace {

constexpr int kDeepest = 12;           // halvings of a cell
constexpr double kFromTheLeft = 1e-9;  // share of a span by which its end is approached

/// A place with its feedrate limit.
struct GridPoint {
  double s = 0.0;
  path::PathPoint at;
  double limit = 0.0;  // [mm/s]
};

double square(double x) { return x * x; }

/// Least length of a vector that goes linearly from a to b.
double least_norm(const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double dd = d.squaredNorm();
  const double x = dd > 0.0 ? std::clamp(-a.dot(d) / dd, 0.0, 1.0) : 0.0;
  return (a + x * d).norm();
}

/// Divides one segment.
class Divider {
 public:
  Divider(const path::Segment& segment, std::span<const LimitZone> zones,
          const feedrate::FeedrateRules& rules, const Limits& limits, const Fineness& fineness,
          std::vector<Cell>& cells)
      : segment_(segment),
        zones_(zones),
        rules_(rules),
        limits_(limits),
        fineness_(fineness),
        cells_(cells),
        has_axes_(limits.axis_acceleration.maxCoeff() > 0.0 ||
                  limits.axis_feedrate.maxCoeff() > 0.0),
        first_(cells.size()) {}

  void divide();

 private:
  void divide_line();
  void divide_arc(const path::Arc& arc);
  void divide_curve(const path::FittedCurve& curve);
  double limit_at(const path::PathPoint& at) const;
  double zone_limit(double begin, double end) const;
  double largest_limit(const GridPoint& a, const GridPoint& b) const;
  void append(const GridPoint& a, const GridPoint& b, double limit);
  void append_free(double length, double limit, double acceleration);
  double axis_feedrate(const GridPoint& a, const GridPoint& b) const;
  double line_acceleration(const Vec3& tangent) const;

  /// Halves [x0, x1] until it is fine enough.
  /// @param place_at  the place at x between
  template <class PlaceAt>
  void halve(double x0, const GridPoint& a, double x1, const GridPoint& b, const PlaceAt& place_at,
             int depth) {
    const double limit = largest_limit(a, b);
    const double least = std::max(std::min(a.limit, b.limit), zone_limit(a.s, b.s));
    const bool varies = limit > (1.0 + fineness_.limit) * least;
    const bool turns = has_axes_ && (b.at.tangent - a.at.tangent).norm() > fineness_.turn;
    if (depth == kDeepest || !(varies || turns)) {
      append(a, b, limit);
      return;
    }
    const double x = 0.5 * (x0 + x1);
    const GridPoint middle = place_at(x);
    halve(x0, a, x, middle, place_at, depth + 1);
    halve(x, middle, x1, b, place_at, depth + 1);
  }

  const path::Segment& segment_;
  std::span<const LimitZone> zones_;
  const feedrate::FeedrateRules& rules_;
  const Limits& limits_;
  const Fineness& fineness_;
  std::vector<Cell>& cells_;
  bool has_axes_;
  std::size_t first_;  // cell of this segment
};

double Divider::limit_at(const path::PathPoint& at) const {
  const On what =
      std::holds_alternative<path::FittedCurve>(segment_.geometry) ? On::kCurve : On::kArcOrLine;
  const auto place = rules_.needs_turning() ? feedrate::local_geometry(at)
                                            : feedrate::LocalGeometry{at.curvature.norm()};
  return rules_.limit_at(place, segment_.feedrate, what);
}

double Divider::largest_limit(const GridPoint& a, const GridPoint& b) const {
  double limit = std::max(a.limit, b.limit);
  if (!rules_.needs_turning() && std::holds_alternative<path::FittedCurve>(segment_.geometry)) {
    const double least = least_norm(a.at.curvature, b.at.curvature);
    limit = std::max(limit, rules_.limit_at({least}, segment_.feedrate, On::kCurve));
  }
  return std::max(limit, zone_limit(a.s, b.s));
}

/// Largest limit of the zones between two places [mm/s]. A zone may have a larger limit than the
/// rules: the planner allows a rounded corner the error of corners.
double Divider::zone_limit(double begin, double end) const {
  const auto first = std::partition_point(zones_.begin(), zones_.end(),
                                          [&](const LimitZone& zone) { return zone.end <= begin; });
  double limit = 0.0;
  for (auto zone = first; zone != zones_.end() && zone->begin < end; ++zone) {
    limit = std::max(limit, zone->limit);
  }
  return std::min(limit, segment_.feedrate);
}

/// Largest feedrate that the axes allow somewhere between two places [mm/s].
double Divider::axis_feedrate(const GridPoint& a, const GridPoint& b) const {
  double least = kNoCap;
  for (int i = 0; i < 3; ++i) {
    const double t0 = a.at.tangent[i];
    const double t1 = b.at.tangent[i];
    if (limits_.axis_feedrate[i] > 0.0 && t0 * t1 > 0.0) {
      least = std::min(least, limits_.axis_feedrate[i] / std::min(std::abs(t0), std::abs(t1)));
    }
  }
  return least;
}

/// Largest acceleration along a straight line [mm/s^2].
double Divider::line_acceleration(const Vec3& tangent) const {
  double least = limits_.acceleration;
  for (int i = 0; i < 3; ++i) {
    if (limits_.axis_acceleration[i] > 0.0 && tangent[i] != 0.0) {
      least = std::min(least, limits_.axis_acceleration[i] / std::abs(tangent[i]));
    }
  }
  return least;
}

void Divider::append_free(double length, double limit, double acceleration) {
  const double cap = square(limit);
  if (cells_.size() > first_ && cells_.back().cap == cap && cells_.back().strips.count == 0) {
    cells_.back().length += length;
    return;
  }
  cells_.push_back({length, cap, acceleration, {}});
}

void Divider::append(const GridPoint& a, const GridPoint& b, double limit) {
  const double length = b.s - a.s;
  if (length <= 0.0) {
    return;
  }
  if (!has_axes_) {
    append_free(length, limit, limits_.acceleration);
    return;
  }
  Cell cell{length, square(std::min(limit, axis_feedrate(a, b))), limits_.acceleration, {}};
  for (int i = 0; i < 3; ++i) {
    const double most = limits_.axis_acceleration[i];
    if (most > 0.0) {
      const double k = b.at.curvature[i];
      cell.strips.add({a.at.tangent[i], a.at.curvature[i], most});
      cell.strips.add({b.at.tangent[i] + 2.0 * length * k, k, most});
    }
  }
  cells_.push_back(cell);
}

void Divider::divide_line() {
  const GridPoint at{0.0, segment_.begin, limit_at(segment_.begin)};
  append_free(segment_.length, std::min(at.limit, axis_feedrate(at, at)),
              line_acceleration(segment_.begin.tangent));
}

void Divider::divide_arc(const path::Arc& arc) {
  const auto place_at = [&](double s) {
    GridPoint place{s, path::point_at(arc, s), 0.0};
    place.limit = limit_at(place.at);
    return place;
  };
  if (!has_axes_ && !rules_.needs_turning()) {
    const double limit = std::max(place_at(0.5 * arc.length).limit, zone_limit(0.0, arc.length));
    append_free(segment_.length, limit, limits_.acceleration);
    return;
  }
  // Before halving there is at least a piece for each radian, so that no whole turn looks like
  // none.
  const GridPoint begin_of_arc = place_at(0.0);
  const double turn = segment_.length * begin_of_arc.at.curvature.norm();
  const int pieces = std::max(16, static_cast<int>(std::ceil(turn)));
  GridPoint begin = begin_of_arc;
  for (int i = 1; i <= pieces; ++i) {
    const GridPoint end = place_at(segment_.length * i / pieces);
    halve(begin.s, begin, end.s, end, place_at, 0);
    begin = end;
  }
}

void Divider::divide_curve(const path::FittedCurve& curve) {
  const auto& samples = curve.curvature;
  const auto local_geometry = [&](double u, double s) {
    GridPoint place{s, path::point_from(curve.curve.derivatives(u)), 0.0};
    place.limit = limit_at(place.at);
    return place;
  };
  const auto place_at = [&](double u) {
    return local_geometry(u, curve.arc_length.s_at(curve.curve, u));
  };
  const bool may_skip = !has_axes_ && !rules_.needs_turning();
  const double fastest = rules_.limit_at({0.0}, segment_.feedrate, On::kCurve);
  const auto is_free = [&](const geometry::CurvatureSample& sample) {
    return rules_.limit_at({sample.curvature}, segment_.feedrate, On::kCurve) >= fastest;
  };
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto& a = samples[i - 1];
    const auto& b = samples[i];
    if (may_skip && is_free(a) && is_free(b)) {
      append_free(b.s - a.s, fastest, limits_.acceleration);
      continue;
    }
    halve(a.u, local_geometry(a.u, a.s), b.u, local_geometry(b.u - kFromTheLeft * (b.u - a.u), b.s),
          place_at, 0);
  }
}

void Divider::divide() {
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment_.geometry)) {
    divide_curve(*curve);
  } else if (const auto* arc = std::get_if<path::Arc>(&segment_.geometry)) {
    divide_arc(*arc);
  } else if (std::holds_alternative<path::Line>(segment_.geometry)) {
    divide_line();
  } else if (std::holds_alternative<path::CornerMotion>(segment_.geometry)) {
    append_free(segment_.length, zone_limit(0.0, segment_.length), limits_.acceleration);
  }
}

}  // namespace

void append_cells(const path::Segment& segment, std::span<const LimitZone> zones,
                  const feedrate::FeedrateRules& rules, const Limits& limits,
                  const Fineness& fineness, std::vector<Cell>& cells) {
  Divider(segment, zones, rules, limits, fineness, cells).divide();
}

}  // namespace twin::feedrate
