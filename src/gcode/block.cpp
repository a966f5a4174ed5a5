#include "gcode/block.hpp"

#include <fmt/format.h>

#include <utility>

namespace twin::gcode {
namespace {

constexpr double kStill = 1e-7;  // of the mean of |C'|

}  // namespace

Expected<std::shared_ptr<const ProgrammedCurve>> make_programmed_curve(geometry::Curve curve) {
  auto made = std::make_shared<ProgrammedCurve>();
  made->curve = std::move(curve);
  made->arc_length.build(made->curve, &made->samples);
  const double length = made->arc_length.length();
  if (!(length > kNoLength)) {
    return fail(ErrorCode::kProgram, "the NURBS has no length: expected control points apart");
  }
  const double still = kStill * length / (made->curve.u_max() - made->curve.u_min());
  for (const geometry::CurvatureSample& sample : made->samples) {
    const geometry::Derivatives at = made->curve.derivatives(sample.u);
    if (!(at.first.norm() > still)) {
      return fail(ErrorCode::kProgram,
                  fmt::format("the NURBS has no tangent at parameter {:.6g} (X{:.4f} Y{:.4f} "
                              "Z{:.4f}): expected no cusp and no control points that coincide",
                              sample.u, at.position.x(), at.position.y(), at.position.z()));
    }
  }
  return made;
}

}  // namespace twin::gcode
