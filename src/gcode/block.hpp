#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "geometry/arc.hpp"
#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::gcode {

enum class Motion : std::uint8_t {
  kRapid,   ///< G00, a straight line at the rapid feedrate
  kLinear,  ///< G01
  kArc,     ///< G02, G03, with or without a helix's rise
  kNurbs,   ///< G05.2 to G05.3, G06.2: a curve given by its control points
  kDwell,   ///< G04, and the stops of M00 and M06 (dwell 0): the path comes to rest here
};

/// How the path may be followed at the end of a block.
enum class PathMode : std::uint8_t {
  kContinuous,  ///< G64: look-ahead, curves through short blocks
  kExactStop,   ///< G61, G61.1: the block is followed exactly and ends at rest
};

/// Lengths below this count as none: an arc from a point to itself is a full circle [mm].
inline constexpr double kNoLength = 1e-9;

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

/// One line of an NC program that moves (or rests), in absolute millimetres.
struct Block {
  Motion motion = Motion::kLinear;
  PathMode path_mode = PathMode::kContinuous;
  std::int16_t work_offset = 0;  ///< in force: 0 for G54 to 8 for G59.3, then those of G54.1
  std::int32_t tool = 0;         ///< in the spindle; 0: none
  Vec3 start = Vec3::Zero();     ///< [mm]
  Vec3 end = Vec3::Zero();       ///< [mm]
  geometry::Arc arc;             ///< used when motion is kArc
  std::shared_ptr<const ProgrammedCurve> nurbs;  ///< not null when motion is kNurbs
  double feedrate = 0.0;      ///< programmed feedrate [mm/s]; 0 for kRapid and kDwell
  double tolerance = 0.0;     ///< path tolerance of G64 P [mm]; 0: the machine's own
  double dwell = 0.0;         ///< time at rest [s], kDwell only
  double program_zero = 0.0;  ///< height of the program's Z0 on the machine [mm]
  std::int64_t line = 0;      ///< line of the program from 1; of a NURBS its first
};

}  // namespace twin::gcode
