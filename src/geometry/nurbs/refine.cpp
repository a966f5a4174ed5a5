#include "geometry/nurbs/refine.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <optional>
#include <utility>

namespace twin::geometry {
namespace {

using Vec4 = Eigen::Vector4d;  // homogeneous: (w P, w)

Vec4 lifted(const Curve& curve, std::size_t i) {
  const double w = curve.is_rational() ? curve.weights()[i] : 1.0;
  const Vec3 p = w * curve.control_points()[i];
  return {p.x(), p.y(), p.z(), w};
}

/// F_s(v_1, ..., v_p): round r replaces d_j, j = p..r, by
///   d_j <- d_{j-1} + a (d_j - d_{j-1}),   a = (v_r - u_{s-p+j}) / (u_{s+1+j-r} - u_{s-p+j}).
Vec4 blossom(const Curve& curve, std::size_t span, const double* v) {
  const auto p = static_cast<std::size_t>(curve.degree());
  const std::vector<double>& u = curve.knots();
  std::array<Vec4, kMaxDegree + 1> d;
  for (std::size_t j = 0; j <= p; ++j) {
    d[j] = lifted(curve, span - p + j);
  }
  for (std::size_t r = 1; r <= p; ++r) {
    for (std::size_t j = p; j >= r; --j) {
      const double low = u[span - p + j];
      const double share = (v[r - 1] - low) / (u[span + 1 + j - r] - low);
      d[j] = (1.0 - share) * d[j - 1] + share * d[j];
    }
  }
  return d[p];
}

/// Refinement with the ends given where they are known.
Curve make(const Curve& curve, std::vector<double> knots, const std::optional<Vec3>& first,
           const std::optional<Vec3>& last) {
  const auto p = static_cast<std::size_t>(curve.degree());
  const std::vector<double>& u = curve.knots();
  std::vector<Vec3> points;
  std::vector<double> weights;
  points.reserve(knots.size() - p - 1);
  auto span = static_cast<std::size_t>(curve.find_span(knots.front()));
  for (std::size_t i = 0; i + p + 1 < knots.size(); ++i) {
    while (span + p + 2 < u.size() && u[span + 1] <= knots[i]) {
      ++span;
    }
    const Vec4 q = blossom(curve, span, knots.data() + i + 1);
    points.emplace_back(q.head<3>() / q.w());
    if (curve.is_rational()) {
      weights.push_back(q.w());
    }
  }
  points.front() = first.value_or(points.front());
  points.back() = last.value_or(points.back());
  auto refined =
      Curve::create(curve.degree(), std::move(knots), std::move(points), std::move(weights));
  assert(refined);
  return refined ? std::move(*refined) : curve;
}

/// Parameters where a cut falls, both ends of the domain included.
std::vector<double> cuts_of(const Curve& curve, const SplitRule& rule) {
  const std::vector<double>& u = curve.knots();
  const auto p = static_cast<std::size_t>(curve.degree());
  std::vector<double> cuts = {curve.u_min()};
  int spans = 0;
  for (std::size_t i = p + 1; i + p + 1 < u.size();) {
    const double knot = u[i];
    int multiplicity = 0;
    for (; i + p + 1 < u.size() && u[i] == knot; ++i) {
      ++multiplicity;
    }
    ++spans;
    if (curve.degree() - multiplicity < rule.least_continuity || spans == rule.most_spans) {
      cuts.push_back(knot);
      spans = 0;
    }
  }
  cuts.push_back(curve.u_max());
  return cuts;
}

}  // namespace

Curve refine(const Curve& curve, std::vector<double> knots) {
  std::optional<Vec3> first;
  std::optional<Vec3> last;
  if (knots.front() == curve.u_min()) {
    first = curve.control_points().front();
  }
  if (knots.back() == curve.u_max()) {
    last = curve.control_points().back();
  }
  return make(curve, std::move(knots), first, last);
}

std::vector<Curve> split(const Curve& curve, const SplitRule& rule) {
  const std::vector<double> cuts = cuts_of(curve, rule);
  const std::vector<double>& u = curve.knots();
  const auto order = static_cast<std::size_t>(curve.degree()) + 1;
  std::vector<Curve> pieces;
  pieces.reserve(cuts.size() - 1);
  std::size_t at = order;
  Vec3 joint = curve.control_points().front();
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    std::vector<double> knots(order, cuts[k]);
    while (at + order < u.size() && u[at] <= cuts[k]) {
      ++at;
    }
    for (; at + order < u.size() && u[at] < cuts[k + 1]; ++at) {
      knots.push_back(u[at]);
    }
    knots.insert(knots.end(), order, cuts[k + 1]);
    std::optional<Vec3> last;
    if (k + 2 == cuts.size()) {
      last = curve.control_points().back();
    }
    pieces.push_back(make(curve, std::move(knots), joint, last));
    joint = pieces.back().control_points().back();
  }
  return pieces;
}

}  // namespace twin::geometry
