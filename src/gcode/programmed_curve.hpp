#pragma once

#include <memory>
#include <vector>

#include "core/error.hpp"
#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::gcode {

/// A NURBS that a program gives by its control points (G05.2, G06.2), measured.
struct ProgrammedCurve {
  geometry::Curve curve;                           ///< control points in absolute mm
  geometry::ArcLength arc_length;                  ///< of the curve
  std::vector<geometry::CurvatureSample> samples;  ///< ascending in s, both ends included
};

/// Measures a curve. Refuses one that has no length, and one that stands still somewhere:
///   |C'(u)| < 1e-7 L / (u_max - u_min),
/// L its length, at a cusp or where control points coincide; it has no tangent there.
Expected<std::shared_ptr<const ProgrammedCurve>> make_programmed_curve(geometry::Curve curve);

}  // namespace twin::gcode
