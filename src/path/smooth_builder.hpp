#pragma once

#include <cstdint>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/block.hpp"
#include "path/builder.hpp"
#include "path/joiner.hpp"
#include "path/segment_writer.hpp"
#include "smoothing/run_spline.hpp"

namespace twin::path {

/// Turns blocks into a path of continuous tangent and curvature within the tolerance, with a bound
/// of its deviation on every segment.
///
/// The tolerance of a block is that of its G64 P, else the corner error, in runs no more than the
/// chord error. Two G01 blocks meet in a smooth vertex if neither is longer than a short block and
/// the sagitta there (bi_chord_error) is no more than half the tolerance; at what feedrate does not
/// matter. Blocks between smooth vertices are a run (smoothing::RunSpline); all other vertices are
/// corners (Joiner).
///
/// Blocks of G61 stay as they are and end at rest, and so does what meets them at an angle; so do
/// NURBS of the program.
class SmoothBuilder : public Builder {
 public:
  SmoothBuilder(const PathSettings& settings, const PlanningModel& model, const Limits& limits,
                Sink sink);

  void push(const gcode::Block& block) override;
  void finish() override;

 private:
  double run_tolerance(const gcode::Block& block) const;
  double corner_tolerance(const gcode::Block& block) const;
  bool is_short(const gcode::Block& block) const;
  bool continues_run(const gcode::Block& block) const;
  double add_block(const gcode::Block& block, double length, std::int64_t number);
  void push_line(const gcode::Block& block, std::int64_t number);
  void push_nurbs(const gcode::Block& block, std::int64_t number);
  void put_whole(Segment&& segment);

  PathSettings settings_;
  PlanningModel model_;
  Limits limits_;
  SegmentWriter writer_;
  Joiner joiner_;
  smoothing::RunSpline run_;
  gcode::Block last_;    // last block of the run
  double length_ = 0.0;  // of the base path [mm]
  std::int64_t next_block_ = 0;
};

}  // namespace twin::path
