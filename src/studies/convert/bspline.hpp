#pragma once

#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {

/// BSPLINE of SINUMERIK controls: control points with weights and the distances of the knots.
///
///     G1                          ends a spline before it
///     BSPLINE SD=3                degree, 2 or 3
///     X1 Y1 PL=0.5 PW=1           control point i >= 1, PL = u_{i+p} - u_{i+p-1}; PW its weight
///
/// The position before is the first control point, of weight 1: all weights are divided by its own,
/// which does not change the curve. PL of the control points 1, 2, ... is the length of the first,
/// second, ... span; the last p - 1, for which no span is left, have PL=0. PW is from 0 to 3.
/// Source: Siemens, SINUMERIK 840D sl / 828D Programming Manual, Job Planning (Work Preparation),
/// "Spline interpolation (ASPLINE, BSPLINE, CSPLINE, BAUTO, BNAT, BTAN, EAUTO, ENAT, ETAN, PW, SD,
/// PL)". The manual says that PL is the distance between nodes and not which block has which;
/// this assignment is that of published writers. Try the first program with the control's
/// simulation.
class Bspline final : public Dialect {
 public:
  std::string_view name() const override { return "bspline"; }
  std::string_view control() const override { return "SINUMERIK, BSPLINE"; }
  std::string_view extension() const override { return ".mpf"; }
  std::string comment(std::string_view text) const override;
  std::string preamble() const override { return "G71 G17 G90 G94"; }
  std::string path_mode(gcode::PathMode mode, double tolerance) const override;
  std::string dwell(double duration) const override;
  Expected<CurveCounts> write_curve(const CurveRequest& request, std::string& text) const override;
};

}  // namespace twin::studies::convert
