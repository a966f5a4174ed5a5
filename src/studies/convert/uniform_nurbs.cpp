#include "studies/convert/uniform_nurbs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "geometry/nurbs/deviation.hpp"
#include "geometry/nurbs/fit.hpp"
#include "geometry/nurbs/refine.hpp"
#include "studies/convert/dialect.hpp"
#include "studies/convert/uniform_refit.hpp"

namespace twin::studies::convert {
namespace {

constexpr double kRefitShare = 0.1;  // of the tolerance may go into other knots
constexpr double kRounding = 1e-6;   // of coordinates in the file [mm]
constexpr double kFlat = 1e-9;       // out of the plane [mm]
constexpr int kUniformWeightDecimals = 9;
constexpr std::size_t kFrame = 2;  // lines of a NURBS besides its further control points

bool is_flat(const geometry::Curve& curve) {
  const double z = curve.control_points().front().z();
  for (const Vec3& point : curve.control_points()) {
    if (std::abs(point.z() - z) > kFlat) {
      return false;
    }
  }
  return true;
}

std::size_t lines_of(const std::vector<geometry::Curve>& pieces) {
  std::size_t lines = 0;
  for (const geometry::Curve& piece : pieces) {
    lines += piece.control_points().size() - 1 + kFrame;
  }
  return lines;
}

/// How far the knots may move the curve: up to the share, within what the fit leaves of the
/// tolerance [mm].
double room_of(const CurveRequest& request) {
  std::vector<double> lengths = {0.0};
  for (std::size_t i = 1; i < request.polygon.size(); ++i) {
    lengths.push_back(lengths.back() + (request.polygon[i] - request.polygon[i - 1]).norm());
  }
  const double used = geometry::deviation_bound(request.curve, request.polygon, lengths);
  return std::min(kRefitShare * request.tolerance, request.tolerance - used - kRounding);
}

}  // namespace

Expected<CurveCounts> UniformNurbs::write_curve(const CurveRequest& request,
                                                std::string& text) const {
  const geometry::Curve& curve = request.curve;
  if (!is_flat(curve)) {
    return refuse_curve(request,
                        "the curve that begins here leaves the XY plane, which G5.2 cannot write: "
                        "expected --to g6.2 or bspline");
  }
  if (curve.degree() < 2) {
    return refuse_curve(request,
                        "a NURBS of degree 1 cannot be written as G5.2: its least degree is 2");
  }
  CurveCounts counts;
  if (has_uniform_knots(curve)) {
    append(curve, text, counts);
    return counts;
  }
  const std::vector<geometry::Curve> pieces = geometry::bezier_pieces(curve);
  if (!request.polygon.empty()) {
    const auto most = static_cast<int>(lines_of(pieces) - kFrame) - 3;  // n = spans + degree
    if (const auto fitted = uniform_refit(curve, room_of(request), most)) {
      append(*fitted, text, counts);
      counts.refitted = 1;
      return counts;
    }
  }
  for (const geometry::Curve& piece : pieces) {
    append(piece, text, counts);
  }
  return counts;
}

void UniformNurbs::append(const geometry::Curve& curve, std::string& text,
                          CurveCounts& counts) const {
  const std::vector<Vec3>& points = curve.control_points();
  const auto weight = [&](std::size_t i) {
    return curve.is_rational() ? number(curve.weights()[i], kUniformWeightDecimals)
                               : std::string("1");
  };
  auto out = std::back_inserter(text);
  fmt::format_to(out, "G05.2 P{} L{}\n", weight(0), curve.degree() + 1);
  for (std::size_t i = 1; i < points.size(); ++i) {
    fmt::format_to(out, "X{} Y{} P{}\n", number(points[i].x(), decimals()),
                   number(points[i].y(), decimals()), weight(i));
  }
  text += "G05.3\n";
  ++counts.blocks;
  counts.control_points += static_cast<std::int64_t>(points.size());
}

}  // namespace twin::studies::convert
