#pragma once

#include <functional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/path_settings.hpp"
#include "feedrate/planned_segment.hpp"
#include "gcode/reader.hpp"
#include "results/metrics/running.hpp"
#include "results/metrics/summary.hpp"

namespace twin::runtime {

/// What planning counts on its way.
struct PlanFigures {
  std::int64_t blocks = 0;        ///< blocks of the program that move
  results::Running short_length;  ///< lengths of the continuous short blocks, fitted by curves [mm]
  std::int64_t curves = 0;        ///< fitted, and NURBS of the program or parts of them
  std::int64_t fitted_curves = 0;  ///< of them, through continuous short blocks
  std::int64_t spans = 0;          ///< of the fitted curves
  std::int64_t lines = 0;
  std::int64_t arcs = 0;
  std::int64_t last_short = -1;  ///< number of the last block counted in short_length
  double path_length = 0.0;      ///< along the segments [mm]
  double time = 0.0;             ///< planned time [s]
  double deviation = 0.0;        ///< largest of the segments' bounds [mm]
  std::int64_t fallbacks = 0;    ///< plans that could not be made and followed an earlier one
};

/// Counts a segment that the path builder has made.
///
/// @param short_block_length  a longer block is no short one, though a corner's curve is part of it
void count(const path::Segment& segment, double short_block_length, PlanFigures& figures);

/// The whole planning chain, text to planned segments: Reader, path::Builder, LookAhead.
///
/// @param sink     takes each planned segment; returns false to stop
/// @param inspect  if given, sees each block before it is planned; an error ends planning
Expected<PlanFigures> plan_program(
    gcode::Reader& reader, const config::MachineFile& machine,
    const std::function<bool(feedrate::PlannedSegment&&)>& sink,
    const std::function<Expected<void>(const gcode::Block&)>& inspect = {});

/// The figures of a plan where the summary has them.
///
/// @param planner  that made the plan; the certified one has certified its deviation
void put_into(results::Summary& summary, const PlanFigures& figures, Planner planner);

}  // namespace twin::runtime
