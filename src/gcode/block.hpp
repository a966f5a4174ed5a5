#pragma once

#include <cstdint>
#include <memory>

#include "core/vec.hpp"

namespace twin::gcode {

struct ProgrammedCurve;

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

/// Circular arc or helix in space, seen from its axis.
///
/// Point at fraction f in [0, 1] of the arc, with a(f) = f sweep:
///   centre + (radius + f radius_change) (cos a(f) e1 + sin a(f) e2) + f rise (e1 x e2)
/// At f = 0 it is the block's start, at f = 1 its end. radius_change is the rounding of the
/// program's numbers.
struct ArcGeometry {
  Vec3 centre = Vec3::Zero();  ///< centre, at the height of the start point [mm]
  Vec3 e1 = Vec3::UnitX();     ///< unit vector from the centre to the start point
  Vec3 e2 = Vec3::UnitY();     ///< unit vector, 90 deg further in the sense of motion
  double radius = 0.0;         ///< radius at the start, > 0 [mm]
  double radius_change = 0.0;  ///< radius at the end less radius at the start [mm]
  double sweep = 0.0;          ///< angle travelled, > 0 [rad]
  double rise = 0.0;           ///< travel along e1 x e2 over the whole arc, signed [mm]
};

/// One line of an NC program that moves (or rests), in absolute millimetres.
struct Block {
  Motion motion = Motion::kLinear;
  PathMode path_mode = PathMode::kContinuous;
  Vec3 start = Vec3::Zero();                     ///< [mm]
  Vec3 end = Vec3::Zero();                       ///< [mm]
  ArcGeometry arc;                               ///< used when motion is kArc
  std::shared_ptr<const ProgrammedCurve> nurbs;  ///< not null when motion is kNurbs
  double feedrate = 0.0;   ///< programmed feedrate [mm/s]; 0 for kRapid and kDwell
  double tolerance = 0.0;  ///< path tolerance of G64 P [mm]; 0: the machine's own
  double dwell = 0.0;      ///< time at rest [s], kDwell only
  std::int64_t line = 0;   ///< line of the program from 1; of a NURBS its first
};

}  // namespace twin::gcode
