#include "studies/convert/bspline.hpp"

#include <fmt/format.h>

#include <iterator>

#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {
namespace {

constexpr double kMostWeight = 3.0;
constexpr int kPwDecimals = 4;  // the increment of PW is 0.0001

}  // namespace

std::string Bspline::comment(std::string_view text) const { return fmt::format("; {}", text); }

std::string Bspline::path_mode(gcode::PathMode mode, double tolerance) const {
  if (mode == gcode::PathMode::kExactStop) {
    return "G60";
  }
  return tolerance > 0.0 ? fmt::format("G64 ; tolerance {} mm", number(tolerance, 6)) : "G64";
}

std::string Bspline::dwell(double duration) const {
  return fmt::format("G4 F{}", number(duration, 6));
}

Expected<CurveCounts> Bspline::write_curve(const CurveRequest& request, std::string& text) const {
  const geometry::Curve& curve = request.curve;
  if (curve.degree() != 2 && curve.degree() != 3) {
    return refuse_curve(request, fmt::format("a NURBS of degree {} cannot be written as BSPLINE: "
                                             "it has degree 2 or 3",
                                             curve.degree()));
  }
  const auto p = static_cast<std::size_t>(curve.degree());
  const std::vector<Vec3>& points = curve.control_points();
  const std::vector<double>& u = curve.knots();
  std::string z = number(points.front().z(), decimals());
  auto out = std::back_inserter(text);
  fmt::format_to(out, "G1\nBSPLINE SD={}\n", p);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double weight = curve.is_rational() ? curve.weights()[i] / curve.weights()[0] : 1.0;
    if (weight > kMostWeight) {
      return refuse_curve(request,
                          fmt::format("a weight {:.6g} times that of the first control point "
                                      "cannot be written as BSPLINE: PW ends at {:g}",
                                      weight, kMostWeight));
    }
    std::string here = number(points[i].z(), decimals());
    const std::string z_word = here == z ? "" : " Z" + here;
    z = std::move(here);
    const double span = u[i + p] - u[i + p - 1];
    fmt::format_to(out, "X{} Y{}{} PL={}{}\n", number(points[i].x(), decimals()),
                   number(points[i].y(), decimals()), z_word, number(span, decimals()),
                   curve.is_rational() ? " PW=" + number(weight, kPwDecimals) : "");
  }
  return CurveCounts{1, static_cast<std::int64_t>(points.size()), 0};
}

}  // namespace twin::studies::convert
