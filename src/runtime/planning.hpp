#pragma once

#include <cstdint>
#include <functional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/path_settings.hpp"
#include "feedrate/planned_segment.hpp"
#include "gcode/reader.hpp"
#include "results/metrics/running.hpp"
#include "results/metrics/summary.hpp"

namespace twin::runtime {

/// Lengths, counts and times that planning adds up.
struct PlanFigures {
  std::int64_t blocks = 0;        ///< blocks of the program that move
  results::Running short_length;  ///< lengths of the continuous short blocks, fitted by curves [mm]
  std::int64_t curves = 0;        ///< segments that are curves, fitted or programmed as NURBS
  std::int64_t fitted_curves = 0;  ///< curves that were fitted to continuous short blocks
  std::int64_t spans = 0;          ///< number of spans of the fitted curves
  std::int64_t lines = 0;
  std::int64_t arcs = 0;
  std::int64_t last_short = -1;  ///< number of the last block counted in short_length
  double path_length = 0.0;      ///< length of all segments [mm]
  double time = 0.0;             ///< planned time of motion [s]
  double deviation = 0.0;        ///< largest path::Segment::deviation of all segments [mm]
  std::int64_t fallbacks = 0;    ///< see feedrate::LookAhead::fallbacks()
};

/// Adds a segment that the path builder has made to the figures.
///
/// @param short_block_length  largest length of a short block [mm]; a longer block does not count
///                            as short, even if a rounded corner makes a part of it a curve
void count(const path::Segment& segment, double short_block_length, PlanFigures& figures);

/// In which threads a program is planned. The plan is the same.
enum class PlanThreads : std::uint8_t {
  kOne,     ///< the caller's
  kBeside,  ///< a long program: read, and its path built, in two threads beside the caller's, if
            ///< there is more than one core
};

/// Plans a whole program, from its text to planned segments: Reader -> path::Builder -> LookAhead.
///
/// @param sink     called in the caller's thread with each planned segment; returns false to stop.
///                 Some blocks may have been read beyond what is planned then.
/// @param inspect  if given, called with each block before it is planned, in the thread that reads;
///                 its error ends planning
Expected<PlanFigures> plan_program(
    gcode::Reader& reader, const config::MachineFile& machine,
    const std::function<bool(feedrate::PlannedSegment&&)>& sink,
    const std::function<Expected<void>(const gcode::Block&)>& inspect = {},
    PlanThreads threads = PlanThreads::kOne);

/// Enters the figures of a plan into a summary.
///
/// @param planner  that made the plan; only of the certified one the deviation is a bound
void put_into(results::Summary& summary, const PlanFigures& figures, Planner planner);

}  // namespace twin::runtime
