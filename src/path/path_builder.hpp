#pragma once

#include <cstdint>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/block.hpp"
#include "geometry/nurbs/fit.hpp"
#include "path/builder.hpp"
#include "path/run_fitter.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// Turns blocks into segments, one after the other, looking no further ahead than a curve needs.
///
/// Successive G01 blocks that meet the criterion for continuous short blocks (CSB, Section 2.1 of
/// the paper) form a run; RunFitter makes curves of it. Every other block becomes the line, arc,
/// curve or rest that it is; a NURBS of many spans becomes several segments.
class PathBuilder : public Builder {
 public:
  PathBuilder(const PathSettings& settings, const PlanningModel& model, const Limits& limits,
              Sink sink);

  void push(const gcode::Block& block) override;
  void finish() override;

 private:
  bool is_short(const gcode::Block& block) const;
  bool continues_run(const gcode::Block& block) const;

  PathSettings settings_;
  PlanningModel model_;
  Limits limits_;
  Sink sink_;
  RunFitter run_;
  gcode::Block last_;  // last block of the run
  std::int64_t next_block_ = 0;
};

/// Line, arc or rest of a single block; not for a NURBS.
Segment make_segment(const gcode::Block& block, std::int64_t number, const Limits& limits,
                     const PlanningModel& model);

/// A NURBS in pieces of at most `most_spans` spans, cut where the curvature jumps or the tangent
/// turns.
std::vector<FittedCurve> make_nurbs_curves(const gcode::Block& block, int most_spans);

/// The same as segments.
std::vector<Segment> make_nurbs_segments(const gcode::Block& block, std::int64_t number,
                                         int most_spans, const Limits& limits,
                                         const PlanningModel& model);

}  // namespace twin::path
