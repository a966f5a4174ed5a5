#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/block.hpp"
#include "geometry/smoothing/run_spline.hpp"
#include "path/builder.hpp"
#include "path/corner_judge.hpp"
#include "path/joiner.hpp"
#include "path/segment_writer.hpp"

namespace twin::path {

/// Turns blocks into a path of continuous tangent and curvature within the tolerance, with a bound
/// of its deviation on every segment.
///
/// The tolerance of a block is that of its G64 P, or else the corner error of the machine file. In
/// runs it is also at most the chord error. The vertex between two G01 blocks is smooth if both are
/// short blocks and the sagitta there (bi_chord_error) is within the tolerance, whatever the
/// feedrate. Blocks that are joined by smooth vertices form a run (geometry::RunSpline). All other
/// vertices are corners (Joiner).
///
/// A tiny line, shorter than half of kSpeck times the tolerance, is left out, and the blocks before
/// and after it meet there. The bound of the deviation includes the error that this makes.
///
/// A block of G61 is not changed and ends at rest; a block that meets it at an angle is treated
/// likewise. The NURBS of the program are not changed either. The path comes to rest where one meets
/// its neighbour at an angle, unless the angle is so small that it can be passed (SegmentWriter).
///
/// Of a program of nothing but tiny lines a rest at its start is left, so that every program has a
/// path.
class SmoothBuilder : public Builder {
 public:
  /// @param judge  of corners that had better stay sharp; null: none had
  SmoothBuilder(const PathSettings& settings, const PlanningModel& model, const Limits& limits,
                Sink sink, std::unique_ptr<CornerJudge> judge = nullptr);

  void push(const gcode::Block& block) override;
  void finish() override;

 private:
  /// A line, and the tiny blocks before and after it that are left out.
  struct LineBlock {
    Vec3 start = Vec3::Zero();
    Vec3 end = Vec3::Zero();   // end of the line itself [mm]
    Vec3 last = Vec3::Zero();  // end of the last block that is left out after it [mm]
    double length = 0.0;       // from start to end [mm]
    double tolerance = 0.0;    // of G64 P; 0: that of the machine file [mm]
    bool can_be_short = false;
    BlockDemand demand;
    std::vector<BlockDemand> before;    // left out where it begins
    std::vector<BlockDemand> left_out;  // left out where it ends
  };

  /// What follows the latest line.
  enum class Following : std::uint8_t {
    kConnected,  ///< a line, which then begins at the end of the latest line
    kOther,      ///< anything else, which begins at the programmed place after the blocks left out
  };

  double run_tolerance(double programmed) const;
  double corner_tolerance(double programmed) const;
  bool continues_run(const LineBlock& block) const;
  bool is_short(const gcode::Block& block, double length) const;
  BlockDemand demand_of(const gcode::Block& block, double length, std::int64_t number) const;
  void add_line(const gcode::Block& block, std::int64_t number);
  bool merge_into_line(const gcode::Block& block, const BlockDemand& demand);
  void end_line(Following following);
  void emit_line(LineBlock& line);
  void end_lines();
  void push_arc(const gcode::Block& block, std::int64_t number);
  void push_nurbs(const gcode::Block& block, std::int64_t number);
  void emit_whole(Segment&& segment);
  Segment rest_at_start() const;

  PathSettings settings_;
  PlanningModel model_;
  Limits limits_;
  std::unique_ptr<CornerJudge> judge_;
  SegmentWriter writer_;
  Joiner joiner_;
  geometry::RunSpline run_;
  LineBlock line_;  // latest line, not given to the run or to the joiner yet
  LineBlock last_;  // last line of the current run
  bool has_line_ = false;
  double length_ = 0.0;  // length of the base path so far [mm]
  std::int64_t next_block_ = 0;
};

}  // namespace twin::path
