#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/block.hpp"
#include "geometry/nurbs/bezier_fit.hpp"
#include "geometry/nurbs/fit.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// Fits one run of continuous short blocks by curves: NURBS that join with continuous tangent and
/// curvature, or Bezier pieces that join with continuous tangent.
///
/// A run may be too long for memory, so it is fitted piece by piece, with at most max_segments
/// blocks in each. A piece is fitted as soon as a few points after it are known. At the joint of
/// two pieces both have the same first and second derivative with respect to chord length, namely
/// those of the interpolating curve through the points around the joint. The effect of a point on
/// an interpolating cubic falls by a factor of about 0.27 from point to point, so a handful of
/// points determines the joint.
///
/// If a piece leaves the chord tolerance, it ends before the block in which it deviates most. That
/// block stays a line.
class RunFitter {
 public:
  using Sink = std::function<void(Segment&&)>;

  RunFitter(const PathSettings& settings, const PlanningModel& model, Limits limits, Sink sink);

  bool is_empty() const noexcept { return blocks_.size() == first_; }

  /// Appends a block that continues the run (or begins it).
  void push(const gcode::Block& block, std::int64_t number);
  /// Ends the run and gives all segments that are left to the sink.
  void finish();

 private:
  struct RunBlock {
    gcode::Block block;
    std::int64_t number;
  };

  std::size_t waiting() const noexcept { return blocks_.size() - first_; }
  std::size_t piece_length() const;
  double tolerance() const;
  void emit_piece(std::size_t count);
  geometry::EndCondition condition_at(std::size_t joint);
  geometry::FitResult fit(std::span<const Vec3> points, const geometry::EndCondition& end,
                          geometry::Curve& curve);
  const std::vector<double>& parameters() const;
  std::optional<std::size_t> emit_curve(std::size_t count, const geometry::EndCondition& end);
  std::optional<std::size_t> block_off(const geometry::Curve& curve,
                                       std::span<const Vec3> points) const;
  void emit_segment(FittedCurve&& fitted, std::size_t count);
  void emit_lines(std::size_t count);
  void emit_broken(std::size_t worst);
  void advance(std::size_t count);
  void forget_settled(std::size_t keep);
  void advance_all();

  PathSettings settings_;
  PlanningModel model_;
  Limits limits_;
  Sink sink_;
  geometry::Fitter fitter_;
  geometry::BezierFitter bezier_fitter_;
  std::vector<RunBlock> blocks_;  // those before first_ are fitted, kept for the next joint only
  std::vector<Vec3> points_;      // start of blocks_[0] and the end of each block
  std::size_t first_ = 0;
  geometry::EndCondition begin_;  // of the next piece
};

}  // namespace twin::path
