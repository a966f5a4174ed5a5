#include "studies/convert/knot_nurbs.hpp"

#include <fmt/format.h>

#include <iterator>

#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {
namespace {

constexpr int kWeightDecimals = 9;

}  // namespace

Expected<CurveCounts> KnotNurbs::write_curve(const CurveRequest& request, std::string& text) const {
  const geometry::Curve& curve = request.curve;
  const int rank = curve.degree() + 1;
  if (rank > most_rank()) {
    return refuse_curve(request, fmt::format("a NURBS of degree {} cannot be written for {}: its "
                                             "largest degree is {}",
                                             curve.degree(), control(), most_rank() - 1));
  }
  const auto knot = [&](std::size_t i) {
    return number((curve.knots()[i] - curve.u_min()) * knot_scale(), knot_decimals());
  };
  const std::vector<Vec3>& points = curve.control_points();
  std::string z;
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string here = number(points[i].z(), decimals());
    const std::string z_word = here == z ? "" : " Z" + here;
    z = std::move(here);
    fmt::format_to(out, "{}K{} X{} Y{}{} R{}\n",
                   i == 0 ? fmt::format("G06.2 P{} ", rank) : std::string(), knot(i),
                   number(points[i].x(), decimals()), number(points[i].y(), decimals()), z_word,
                   curve.is_rational() ? number(curve.weights()[i], kWeightDecimals) : "1");
  }
  for (std::size_t i = points.size(); i < curve.knots().size(); ++i) {
    fmt::format_to(out, "K{}\n", knot(i));
  }
  if (has_end_word()) {
    text += "G06.3\n";
  }
  return CurveCounts{1, static_cast<std::int64_t>(points.size()), 0};
}

std::string FanucNurbs::path_mode(gcode::PathMode mode, double /*tolerance*/) const {
  return mode == gcode::PathMode::kExactStop ? "G61" : "G64";
}

std::string FanucNurbs::dwell(double duration) const {
  return fmt::format("G04 P{}", number(duration * 1000.0, 0));  // [ms]
}

}  // namespace twin::studies::convert
