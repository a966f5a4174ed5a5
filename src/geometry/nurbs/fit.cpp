#include "geometry/nurbs/fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/nurbs/basis.hpp"

namespace twin::geometry {
namespace {

constexpr int kDegree = 3;

/// P_1 and P_2 from C' = P_0^(1) and C'' = P_0^(2) at the beginning of the domain [WY09, Eqs. 27,
/// 28]:
///   C' = 3 (P_1 - P_0) / h1,   C'' = 2 (3 (P_2 - P_1) / h2 - C') / h3,
/// h1 = u_4 - u_1, h2 = u_5 - u_2, h3 = u_4 - u_2. Counted from the end, with C' reversed, they are
/// P_{m-1} and P_{m-2}.
///
/// @param sign  1 at the beginning, -1 at the end
void set_clamped_end(const EndCondition& end, double sign, double h1, double h2, double h3,
                     const Vec3& p0, Vec3& p1, Vec3& p2) {
  p1 = p0 + (h1 / kDegree) * sign * end.first;
  p2 = p1 + (h2 / kDegree) * (sign * end.first + (0.5 * h3) * end.second);
}

/// The parabola through three points with chord-length parameters, at point `index`.
EndCondition parabola_condition(std::span<const Vec3> w, std::size_t index) {
  const double h0 = (w[1] - w[0]).norm();
  const double h1 = (w[2] - w[1]).norm();
  if (!(h0 > 0.0) || !(h1 > 0.0)) {
    return {};
  }
  const Vec3 d0 = (w[1] - w[0]) / h0;
  const Vec3 d1 = (w[2] - w[1]) / h1;
  const Vec3 second = 2.0 * (d1 - d0) / (h0 + h1);
  const double from_middle_of_first =
      index == 0 ? -0.5 * h0 : (index == 1 ? 0.5 * h0 : 0.5 * h0 + h1);
  return {true, d0 + from_middle_of_first * second, second};
}

EndCondition line_condition(std::span<const Vec3> w) {
  const double h = (w[1] - w[0]).norm();
  return h > 0.0 ? EndCondition{true, (w[1] - w[0]) / h, Vec3::Zero()} : EndCondition{};
}

}  // namespace

void solve_pentadiagonal(std::span<BandRow> rows, std::span<Vec3> x) noexcept {
  const std::size_t n = rows.size();
  for (std::size_t r = 0; r < n; ++r) {
    BandRow& row = rows[r];
    if (r >= 2) {
      const BandRow& above = rows[r - 2];
      const double factor =
          row[0] * above[2];  // [2] of a finished row is the reciprocal of its pivot
      row[1] -= factor * above[3];
      row[2] -= factor * above[4];
      x[r] -= factor * x[r - 2];
    }
    if (r >= 1) {
      const BandRow& above = rows[r - 1];
      const double factor = row[1] * above[2];
      row[2] -= factor * above[3];
      row[3] -= factor * above[4];
      x[r] -= factor * x[r - 1];
    }
    row[2] = 1.0 / row[2];
  }
  for (std::size_t r = n; r-- > 0;) {
    if (r + 1 < n) {
      x[r] -= rows[r][3] * x[r + 1];
    }
    if (r + 2 < n) {
      x[r] -= rows[r][4] * x[r + 2];
    }
    x[r] *= rows[r][2];
  }
}

bool Fitter::set_parameters(std::span<const Vec3> points) {
  parameters_.resize(points.size());
  parameters_[0] = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    parameters_[i] = parameters_[i - 1] + (points[i] - points[i - 1]).norm();
    if (!(parameters_[i] > parameters_[i - 1])) {
      return false;
    }
  }
  return std::isfinite(parameters_.back());
}

/// Rows of [WY09, Eq. 12] for the inner points; what the known control points contribute goes to
/// the right-hand side.
void Fitter::set_rows(std::span<const Vec3> points, std::size_t first_unknown, const Curve& curve,
                      std::span<Vec3> solution) {
  const std::vector<double>& knots = curve.knots_;
  rows_.resize(solution.size());
  int span = kDegree;
  for (std::size_t r = 0; r < solution.size(); ++r) {
    const double u = parameters_[r + 1];
    while (knots[span + 1] <= u) {
      ++span;
    }
    const Basis<kDegree> basis = evaluate_basis<kDegree>(knots.data() + span, u);
    Vec3 rest = points[r + 1];
    BandRow row{};
    for (int j = 0; j <= kDegree; ++j) {
      const int column = span - kDegree + j;
      const int unknown = column - static_cast<int>(first_unknown);
      const int offset = unknown - static_cast<int>(r) + 2;
      if (unknown < 0 || unknown >= static_cast<int>(solution.size())) {
        rest -= basis.n[j] * curve.control_points_[column];
      } else if (offset >= 0 && offset < 5) {
        row[offset] = basis.n[j];
      }
    }
    rows_[r] = row;
    solution[r] = rest;
  }
}

FitResult Fitter::fit(std::span<const Vec3> points, const EndCondition& begin,
                      const EndCondition& end, Curve& out) {
  const std::size_t known_first = begin.clamped ? 3 : 1;
  const std::size_t known_last = end.clamped ? 3 : 1;
  if (points.size() < 2 || points.size() + known_first + known_last < 2 + kDegree + 1) {
    return FitResult::kTooFewPoints;
  }
  if (!set_parameters(points)) {
    return FitResult::kInvalidPoints;
  }
  const std::size_t inner = points.size() - 2;
  conditions_.assign(known_first, 0.0);
  conditions_.insert(conditions_.end(), parameters_.begin() + 1, parameters_.end() - 1);
  conditions_.insert(conditions_.end(), known_last, parameters_.back());

  out.degree_ = kDegree;
  out.weights_.clear();
  average_knots(kDegree, conditions_, out.knots_);
  out.control_points_.resize(conditions_.size());
  const std::span<Vec3> p = out.control_points_;
  const std::vector<double>& u = out.knots_;
  const std::size_t m = p.size() - 1;
  const std::size_t k = u.size() - 1;
  p[0] = points.front();
  p[m] = points.back();
  if (begin.clamped) {
    set_clamped_end(begin, 1.0, u[4] - u[1], u[5] - u[2], u[4] - u[2], p[0], p[1], p[2]);
  }
  if (end.clamped) {
    set_clamped_end(end, -1.0, u[k - 1] - u[k - 4], u[k - 2] - u[k - 5], u[k - 2] - u[k - 4], p[m],
                    p[m - 1], p[m - 2]);
  }
  const std::span<Vec3> solution = p.subspan(known_first, inner);
  set_rows(points, known_first, out, solution);
  solve_pentadiagonal(rows_, solution);
  return FitResult::kFitted;
}

EndCondition Fitter::condition_at(std::span<const Vec3> window, std::size_t index) {
  if (window.size() < 2 || index >= window.size()) {
    return {};
  }
  if (window.size() == 2) {
    return line_condition(window);
  }
  if (window.size() == 3) {
    return parabola_condition(window, index);
  }
  if (fit(window, {}, {}, window_curve_) != FitResult::kFitted) {
    return {};
  }
  const Derivatives at = window_curve_.derivatives(parameters_[index]);
  return {true, at.first, at.second};
}

EndCondition joint_condition(Fitter& fitter, std::span<const Vec3> window, std::size_t index) {
  return fitter.condition_at(window, index);
}

}  // namespace twin::geometry
