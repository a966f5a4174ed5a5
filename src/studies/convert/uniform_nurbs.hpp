#pragma once

#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {

/// G05.2 to G05.3 of LinuxCNC: control points with weights, on uniform clamped knots.
///
///     G05.2 P1 L4              weight of the position, which is the first control point; order
///     X1 Y1 P1                 every further control point has X, Y and its weight P
///     G05.3
///
/// The control has no word for knots: it takes 0, 1, 2, ... (see gcode::NurbsCollector). A curve on
/// other knots is written
///   - on uniform knots anew, if it then differs by a tenth of the tolerance at most and takes
///     fewer lines (uniform_refit);
///   - else as its Bezier pieces, for which four control points are all there is: exact.
/// Only the XY plane: a curve that leaves it is refused. Source: LinuxCNC, G-Code manual, "G5.2
/// G5.3 NURBS Block". Its interpreter refuses a control point without P, although the manual
/// says 1.
class UniformNurbs final : public Dialect {
 public:
  std::string_view name() const override { return "g5.2"; }
  std::string_view control() const override { return "LinuxCNC, G5.2"; }
  Expected<CurveCounts> write_curve(const CurveRequest& request, std::string& text) const override;

 private:
  void append(const geometry::Curve& curve, std::string& text, CurveCounts& counts) const;
};

}  // namespace twin::studies::convert
