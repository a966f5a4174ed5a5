#pragma once

#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {

/// G06.2: control points with their knots and weights, as LinuxCNC reads it.
///
///     G06.2 P4 Q3 K0 X0 Y0 R1  rank; way to follow the curve; knot, place and weight of the first
///     K0 X1 Y1 R1              control point
///     ...
///     G06.2 K1                 as many knots alone as the rank
///
/// Q3 asks for steps of equal length along the curve. Knots are whole numbers there, so they are
/// multiplied by a power of ten and rounded. Source: see gcode::NurbsCollector, and LinuxCNC's own
/// programs in nc_files/nurbs. LinuxCNC has G06.2 from 2.10 on (the `rs274` of Debian 12 is 2.9 and
/// does not know the word).
class KnotNurbs : public Dialect {
 public:
  std::string_view name() const override { return "g6.2"; }
  std::string_view control() const override { return "LinuxCNC 2.10, G6.2"; }
  Expected<CurveCounts> write_curve(const CurveRequest& request, std::string& text) const override;

 protected:
  virtual int most_rank() const { return 6; }
  virtual std::string_view method_word() const { return "Q3 "; }
  virtual std::string_view closing_word() const { return "G06.2 "; }
  /// Factor of the knots, which only their ratios count of, and their decimals.
  virtual double knot_scale(const geometry::Curve& curve) const;
  virtual int knot_decimals() const { return 0; }
};

/// The same for FANUC: no Q, no word before the closing knots; rank 2 to 4.
///
/// A FANUC of increment system IS-C takes four decimals of a coordinate; knots are whole numbers of
/// the least increment too, hence the factor of 1000. Source: FANUC Series 15i/150i-MA operator's
/// manual (programming), "NURBS interpolation (G06.2)".
class FanucNurbs : public KnotNurbs {
 public:
  std::string_view name() const override { return "fanuc"; }
  std::string_view control() const override { return "FANUC, G06.2"; }
  int decimals() const override { return 4; }
  std::string path_mode(gcode::PathMode mode, double tolerance) const override;
  std::string dwell(double duration) const override;

 protected:
  int most_rank() const override { return 4; }
  std::string_view method_word() const override { return ""; }
  std::string_view closing_word() const override { return ""; }
  double knot_scale(const geometry::Curve& /*curve*/) const override { return 1000.0; }
  int knot_decimals() const override { return 4; }
};

}  // namespace twin::studies::convert
