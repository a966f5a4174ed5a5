#pragma once

#include <span>

#include "geometry/nurbs/span_cubic.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// What lies on one side of a corner.
struct CornerSide {
  PathPoint at;           ///< of the base path, at the corner
  double length = 0.0;    ///< of the element [mm]
  double feedrate = 0.0;  ///< asked for on it [mm/s]
};

/// A corner, and the bump that could round it.
struct RoundedCorner {
  /// The base path with the bump, over [corner - half width, corner + half width].
  std::span<const geometry::SpanCubic> pieces;
  double corner = 0.0;      ///< length of the base path at the corner [mm]
  double half_width = 0.0;  ///< of the bump [mm]
  CornerSide before;
  CornerSide after;
};

/// Says which corners had better stay sharp. The path knows shapes and tolerances; how fast they can
/// be passed is known to who plans the feedrate.
class CornerJudge {
 public:
  CornerJudge() = default;
  CornerJudge(const CornerJudge&) = delete;
  CornerJudge& operator=(const CornerJudge&) = delete;
  virtual ~CornerJudge() = default;

  /// Whether a stop at the sharp corner takes less time than the way through the bump.
  virtual bool is_stop_quicker(const RoundedCorner& corner) = 0;
};

}  // namespace twin::path
