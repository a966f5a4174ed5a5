#pragma once

namespace twin {

/// How NC blocks become segments: which runs are fitted, how closely, and how far ahead the planner
/// looks.
struct PathSettings {
  double chord_error = 0.01;  ///< chord tolerance, and the curve's distance from the polygon [mm]
  int min_segments = 3;       ///< fewest blocks that are fitted into one curve
  int max_segments = 20;      ///< most blocks in one curve
  double short_block_length = 10.0;  ///< a longer block is never part of a run of short ones [mm]
  int look_ahead = 200;              ///< planned segments between planner and interpolator
};

}  // namespace twin
