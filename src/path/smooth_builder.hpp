#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/block.hpp"
#include "geometry/smoothing/run_spline.hpp"
#include "path/builder.hpp"
#include "path/joiner.hpp"
#include "path/segment_writer.hpp"

namespace twin::path {

/// Turns blocks into a path of continuous tangent and curvature within the tolerance, with a bound
/// of its deviation on every segment.
///
/// The tolerance of a block is that of its G64 P, else the corner error, in runs no more than the
/// chord error. Two G01 blocks meet in a smooth vertex if neither is longer than a short block and
/// the sagitta there (bi_chord_error) is no more than the tolerance; at what feedrate does not
/// matter. Blocks between smooth vertices are a run (geometry::RunSpline); all other vertices are
/// corners (Joiner).
///
/// Lines that stay within half of kSpeck of the tolerance of where they begin are left out: the
/// blocks before and after meet there. What that moves is part of the bound.
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
  /// A line, with the blocks behind it that are left out.
  struct LineBlock {
    Vec3 start = Vec3::Zero();
    Vec3 end = Vec3::Zero();   // its own
    Vec3 last = Vec3::Zero();  // of what is left out behind it
    double length = 0.0;       // start to end [mm]
    double tolerance = 0.0;    // of G64 P, 0: the machine's own [mm]
    bool can_be_short = false;
    BlockDemand demand;
    std::vector<BlockDemand> left_out;
  };

  double run_tolerance(double programmed) const;
  double corner_tolerance(double programmed) const;
  bool continues_run(const LineBlock& block) const;
  BlockDemand demand_of(const gcode::Block& block, double length, std::int64_t number) const;
  void take_line(const gcode::Block& block, std::int64_t number);
  bool leave_out(const gcode::Block& block, const BlockDemand& demand);
  void end_line(bool is_last);
  void push_line(LineBlock& line);
  void end_lines();
  void push_arc(const gcode::Block& block, std::int64_t number);
  void put_whole(Segment&& segment);

  PathSettings settings_;
  PlanningModel model_;
  Limits limits_;
  SegmentWriter writer_;
  Joiner joiner_;
  geometry::RunSpline run_;
  LineBlock line_;  // the latest, not pushed yet
  LineBlock last_;  // of the run
  bool has_line_ = false;
  double length_ = 0.0;  // of the base path [mm]
  std::int64_t next_block_ = 0;
};

}  // namespace twin::path
