#pragma once

#include <cstdint>
#include <optional>

#include "gcode/block.hpp"
#include "gcode/words/codes.hpp"

namespace twin::gcode {

class LineWords;

enum class MotionMode : std::uint8_t {
  kNone,  ///< at the start of the program and after G80
  kRapid,
  kLinear,
  kArcClockwise,
  kArcCounterClockwise,
  kNurbs,        ///< G05.2, until G05.3
  kKnotNurbs,    ///< G06.2; stays in force behind the curve's last knot
  kCycle,        ///< a canned cycle, G73 to G89
  kProbe,        ///< G38.2 to G38.5
  kSkip,         ///< G31, on its own line only
  kThread,       ///< G33
  kRigidTap,     ///< G33.1
  kThreadCycle,  ///< G76
};

/// Plane of arcs, named by its axes in right-handed order: the third axis is their cross product.
enum class Plane : std::uint8_t { kXy, kZx, kYz };

/// What the number of an F word means.
enum class FeedMode : std::uint8_t {
  kPerMinute,      ///< G94: units of length per minute
  kPerRevolution,  ///< G95: units of length per revolution of the spindle
  kInverseTime,    ///< G93: moves per minute, for the move of its own line
};

/// What stays in force from line to line.
struct ModalState {
  MotionMode motion = MotionMode::kNone;
  GWord cycle = GWord::kCancelMotion;  ///< word that has set the motion
  /// What G80 leaves in force: with FANUC the last of G00 to G03, elsewhere nothing.
  MotionMode behind_cycle = MotionMode::kNone;
  bool is_fanuc = false;
  Plane plane = Plane::kXy;
  PathMode path_mode = PathMode::kContinuous;
  bool is_incremental = false;        ///< G91: X Y Z are from the position before the line
  bool has_absolute_centres = false;  ///< G90.1: I J K are coordinates
  bool may_guess_centres = false;     ///< no G90.1, G91.1 or arc has said which
  bool is_polar = false;              ///< G16: the plane's axes are radius and angle
  bool returns_to_retract = false;    ///< G99: canned cycles return to R
  bool has_surface_speed = false;     ///< G96: S is a speed of the cut
  FeedMode feed_mode = FeedMode::kPerMinute;
  double unit = 1.0;              ///< length of the program's unit [mm]
  double tolerance = 0.0;         ///< path tolerance of G64 P, 0: the machine's own [mm]
  double feed_number = 0.0;       ///< the last F: mm per minute, mm per revolution, or 1 per minute
  double spindle_rpm = 0.0;       ///< the last S [1/min]
  double default_feedrate = 0.0;  ///< while there is no F, or F0 [mm/s]
  bool has_feed_word = false;     ///< an F was read
  double feedrate = 0.0;  ///< that follows from these, 0 before the first F [mm/s]; with G93
                          ///< the share of a move in a second [1/s]

  bool is_nurbs() const noexcept {
    return motion == MotionMode::kNurbs || motion == MotionMode::kKnotNurbs;
  }
  /// True while the feedrate is none of the program's.
  bool has_default_feedrate() const noexcept {
    return feed_mode == FeedMode::kPerMinute && feed_number == 0.0 && feedrate > 0.0;
  }
  bool is_arc() const noexcept {
    return motion == MotionMode::kArcClockwise || motion == MotionMode::kArcCounterClockwise;
  }
  bool is_probing() const noexcept {
    return motion == MotionMode::kProbe || motion == MotionMode::kSkip;
  }
  /// True for moves whose feedrate is a lead times the speed of the spindle.
  bool is_threading() const noexcept { return motion >= MotionMode::kThread; }
  /// Ends a motion that is in force on its own line only. @param before  that of the line before
  void leave_skip(MotionMode before) noexcept;
};

/// Brings the state up to date with a line, whatever the order of its words.
///
/// Units come first: F and the P of G64 are in the units of their own line.
///
/// @param feedrate  feedrate in place of the F words, if any [mm/s]
void update(ModalState& state, const LineWords& words, const std::optional<double>& feedrate);

}  // namespace twin::gcode
