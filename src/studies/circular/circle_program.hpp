#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"

/// Circular test after ISO 230-4: program, evaluation of both senses, report.
namespace twin::studies::circular {

enum class Sense { kCounterClockwise, kClockwise };
inline constexpr std::array kSenses{Sense::kCounterClockwise, Sense::kClockwise};

/// "ccw" or "cw", as files and keys have it.
std::string_view short_name(Sense sense);
/// 1 counter-clockwise, -1 clockwise.
constexpr double sign_of(Sense sense) { return sense == Sense::kClockwise ? -1.0 : 1.0; }

/// NC line of the measured turn in the text of circle_program().
inline constexpr int kMeasuredLine = 7;

/// NC program of one sense of the test: a turn to run in, the measured turn, half a turn to run
/// out.
///
/// The circle is about X0 Y0, where the machine starts. The turns begin at (0.8, 0.6) of the
/// radius, which lies between the quadrants and has few decimals: the reversals are in the middle
/// of the measured turn, and the arcs are exact.
///
/// @param radius    [mm]
/// @param feedrate  [mm/s]
std::string circle_program(double radius, double feedrate, Sense sense);

/// The measured turn of one sense.
struct MeasuredTurn {
  std::vector<Vec2> table;    ///< true position, what a ballbar sees [mm]
  std::vector<Vec2> encoder;  ///< what the controller sees [mm]
  double feedrate = 0.0;      ///< mean of the set points' [mm/s]
};

/// Reads the rows of the measured turn from the trace of a program of circle_program().
///
/// @returns an Error if the trace has fewer than 60 of them
Expected<MeasuredTurn> read_measured_turn(const std::filesystem::path& trace);

}  // namespace twin::studies::circular
