#include "geometry/nurbs/knot_vector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twin::geometry {
namespace {

tl::unexpected<Error> bad_knots(std::string message) {
  return fail(ErrorCode::kProgram, "knot vector: " + std::move(message));
}

}  // namespace

Expected<void> check_knot_vector(int degree, std::span<const double> knots,
                                 std::size_t control_points) {
  if (degree < 1 || degree > kMaxDegree) {
    return bad_knots(fmt::format("degree {} is outside 1..{}", degree, kMaxDegree));
  }
  const auto p = static_cast<std::size_t>(degree);
  if (control_points < p + 1) {
    return bad_knots(fmt::format("{} control points are too few for degree {}, which needs {}",
                                 control_points, p, p + 1));
  }
  if (knots.size() != control_points + p + 1) {
    return bad_knots(fmt::format("{} knots where {} control points of degree {} need {}",
                                 knots.size(), control_points, p, control_points + p + 1));
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) {
      return bad_knots(fmt::format("knot {} is not a finite number", i));
    }
    if (i > 0 && knots[i] < knots[i - 1]) {
      return bad_knots(
          fmt::format("knot {} ({}) is below the one before it ({})", i, knots[i], knots[i - 1]));
    }
  }
  if (knots[0] != knots[p] || knots[control_points] != knots.back()) {
    return bad_knots(fmt::format("first and last knot must each occur {} times", p + 1));
  }
  for (std::size_t i = 1; i + p + 1 < knots.size(); ++i) {
    if (knots[i] == knots[i + p]) {
      return bad_knots(
          fmt::format("knot {} ({}) is repeated too often for degree {}", i, knots[i], p));
    }
  }
  return {};
}

int find_span(int degree, std::span<const double> knots, double u, int hint) noexcept {
  const int first = degree;
  const int last = static_cast<int>(knots.size()) - degree - 2;
  if (!(u > knots[first])) {
    return first;
  }
  if (u >= knots[last + 1]) {
    return last;
  }
  const auto holds_u = [&](int s) {
    return s >= first && s <= last && knots[s] <= u && u < knots[s + 1];
  };
  if (hint >= first && hint <= last) {
    for (const int s : {hint, hint + 1, hint - 1}) {
      if (holds_u(s)) {
        return s;
      }
    }
  }
  const auto above = std::upper_bound(knots.begin() + first, knots.begin() + last + 1, u);
  return static_cast<int>(above - knots.begin()) - 1;
}

void average_knots(int degree, std::span<const double> t, std::vector<double>& knots) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t n = t.size() - 1;
  knots.resize(n + p + 2);
  std::fill_n(knots.begin(), p + 1, t.front());
  for (std::size_t j = 1; j + p <= n; ++j) {
    double sum = 0.0;
    for (std::size_t i = j; i < j + p; ++i) {
      sum += t[i];
    }
    knots[j + p] = sum / static_cast<double>(p);
  }
  std::fill_n(knots.begin() + static_cast<std::ptrdiff_t>(n + 1), p + 1, t.back());
}

}  // namespace twin::geometry
