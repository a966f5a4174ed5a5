#pragma once

#include <cstdint>
#include <optional>

#include "gcode/block.hpp"

namespace twin::gcode {

class LineWords;

enum class MotionMode : std::uint8_t {
  kNone,  ///< at the start of the program and after G80
  kRapid,
  kLinear,
  kArcClockwise,
  kArcCounterClockwise,
  kNurbs,      ///< G05.2, until G05.3
  kKnotNurbs,  ///< G06.2; stays in force behind the curve's last knot
};

/// Plane of arcs, named by its axes in right-handed order: the third axis is their cross product.
enum class Plane : std::uint8_t { kXy, kZx, kYz };

/// What stays in force from line to line.
struct ModalState {
  MotionMode motion = MotionMode::kNone;
  Plane plane = Plane::kXy;
  PathMode path_mode = PathMode::kContinuous;
  bool is_incremental = false;  ///< G91: X Y Z are from the position before the line
  double unit = 1.0;            ///< length of the program's unit [mm]
  double tolerance = 0.0;       ///< path tolerance of G64 P, 0: the machine's own [mm]
  double feedrate = 0.0;        ///< feedrate of the last F, 0 before the first [mm/s]

  bool is_nurbs() const noexcept {
    return motion == MotionMode::kNurbs || motion == MotionMode::kKnotNurbs;
  }
  bool is_arc() const noexcept {
    return motion == MotionMode::kArcClockwise || motion == MotionMode::kArcCounterClockwise;
  }
};

/// Brings the state up to date with a line, whatever the order of its words.
///
/// Units come first: F and the P of G64 are in the units of their own line.
///
/// @param feedrate  feedrate in place of the F words, if any [mm/s]
void update(ModalState& state, const LineWords& words, const std::optional<double>& feedrate);

}  // namespace twin::gcode
