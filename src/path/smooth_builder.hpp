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
/// The tolerance of a block is that of its G64 P, otherwise the corner error of the machine file;
/// in runs it is also at most the chord error. The vertex between two G01 blocks is smooth if
/// neither block is longer than a short block and the sagitta there (bi_chord_error) is within the
/// tolerance, at any feedrate. The blocks between smooth vertices are a run (geometry::RunSpline).
/// All other vertices are corners (Joiner).
///
/// A line that ends within half of kSpeck of the tolerance from where it begins is left out, and
/// the blocks before and after it meet there. The bound of the deviation includes what that moves.
///
/// A block of G61 stays as it is and ends at rest, and so does a block that meets it at an angle.
/// The same holds for the NURBS of the program.
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

  /// What comes after the latest line.
  enum class Following : std::uint8_t {
    kConnected,  ///< a line that begins at the end of the latest one
    kOther,      ///< something that begins where the program is, behind what was left out
  };

  double run_tolerance(double programmed) const;
  double corner_tolerance(double programmed) const;
  bool continues_run(const LineBlock& block) const;
  BlockDemand demand_of(const gcode::Block& block, double length, std::int64_t number) const;
  void add_line(const gcode::Block& block, std::int64_t number);
  bool merge_into_line(const gcode::Block& block, const BlockDemand& demand);
  void end_line(Following following);
  void emit_line(LineBlock& line);
  void end_lines();
  void push_arc(const gcode::Block& block, std::int64_t number);
  void emit_whole(Segment&& segment);

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
