#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "gcode/block.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::studies::convert {

/// A curve to be written.
struct CurveRequest {
  const geometry::Curve& curve;
  std::span<const Vec3> polygon;  ///< points it was fitted through; empty for a given NURBS [mm]
  double tolerance = 0.0;         ///< path tolerance [mm]
  std::int64_t line = 0;          ///< NC line it comes from
};

/// What a curve has become.
struct CurveCounts {
  std::int64_t blocks = 0;          ///< NURBS written for it
  std::int64_t control_points = 0;  ///< the position before each among them
  std::int64_t refitted = 0;        ///< of the blocks, those with other knots than the curve had
};

/// How one control wants its NURBS, and the few other things that controls write differently.
///
/// G00 to G03, F, G17 to G19, G64 and M30 mean the same to all of them; ProgramWriter writes these.
class Dialect {
 public:
  virtual ~Dialect() = default;

  virtual std::string_view name() const = 0;     ///< as --to takes it
  virtual std::string_view control() const = 0;  ///< "LinuxCNC 2.9"
  virtual std::string_view extension() const { return ".nc"; }
  virtual int decimals() const { return 6; }  ///< of coordinates in mm

  virtual std::string comment(std::string_view text) const;
  /// Units, plane, absolute coordinates, feed per minute.
  virtual std::string preamble() const { return "G21 G17 G90 G94"; }
  virtual std::string path_mode(gcode::PathMode mode, double tolerance) const;
  /// @param duration  [s]
  virtual std::string dwell(double duration) const;

  /// Appends the lines of a curve, which begins where the tool is.
  ///
  /// @returns what was written, or why the control cannot have that curve
  virtual Expected<CurveCounts> write_curve(const CurveRequest& request,
                                            std::string& text) const = 0;
};

/// Names of the dialects.
std::vector<std::string> dialect_names();

/// Whether gcode::Reader reads programs of the dialect.
bool is_readable(std::string_view name);

/// Dialect of a name, or null.
std::unique_ptr<Dialect> make_dialect(std::string_view name);

/// An error of a curve, at its NC line.
tl::unexpected<Error> refuse_curve(const CurveRequest& request, std::string message);

/// A number in the fewest digits with at most so many decimals: "1.25", "-3", "0"; never an
/// exponent, never "-0".
std::string number(double value, int decimals);

/// The value that number() writes.
double rounded(double value, int decimals);

}  // namespace twin::studies::convert
