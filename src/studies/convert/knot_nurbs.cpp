#include "studies/convert/knot_nurbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {
namespace {

constexpr int kWeightDecimals = 9;
constexpr double kWholeDomain = 1e7;  // least last knot of those that are made whole

}  // namespace

Expected<CurveCounts> KnotNurbs::write_curve(const CurveRequest& request, std::string& text) const {
  const geometry::Curve& curve = request.curve;
  const int rank = curve.degree() + 1;
  if (rank > most_rank()) {
    return refuse_curve(request, fmt::format("a NURBS of degree {} cannot be written for {}: its "
                                             "largest degree is {}",
                                             curve.degree(), control(), most_rank() - 1));
  }
  const double scale = knot_scale(curve);
  const auto knot = [&](std::size_t i) {
    return number((curve.knots()[i] - curve.u_min()) * scale, knot_decimals());
  };
  const std::vector<Vec3>& points = curve.control_points();
  std::string z;
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string here = number(points[i].z(), decimals());
    const std::string z_word = here == z ? "" : " Z" + here;
    z = std::move(here);
    fmt::format_to(out, "{}K{} X{} Y{}{} R{}\n",
                   i == 0 ? fmt::format("G06.2 P{} {}", rank, method_word()) : std::string(),
                   knot(i), number(points[i].x(), decimals()), number(points[i].y(), decimals()),
                   z_word, curve.is_rational() ? number(curve.weights()[i], kWeightDecimals) : "1");
  }
  for (std::size_t i = points.size(); i < curve.knots().size(); ++i) {
    fmt::format_to(out, "{}K{}\n", closing_word(), knot(i));
  }
  return CurveCounts{1, static_cast<std::int64_t>(points.size()), 0};
}

/// LinuxCNC reads whole knots: the power of ten that leaves a million steps to the curve, or 1 where
/// they are whole already. Only their ratios count.
double KnotNurbs::knot_scale(const geometry::Curve& curve) const {
  const auto is_whole = [&](double knot) {
    return knot - curve.u_min() == std::floor(knot - curve.u_min());
  };
  if (std::all_of(curve.knots().begin(), curve.knots().end(), is_whole)) {
    return 1.0;
  }
  const double domain = curve.u_max() - curve.u_min();
  return std::pow(10.0, std::max(0.0, std::ceil(std::log10(kWholeDomain / domain))));
}

std::string FanucNurbs::path_mode(gcode::PathMode mode, double /*tolerance*/) const {
  return mode == gcode::PathMode::kExactStop ? "G61" : "G64";
}

std::string FanucNurbs::dwell(double duration) const {
  return fmt::format("G04 P{}", number(duration * 1000.0, 0));  // [ms]
}

}  // namespace twin::studies::convert
