#pragma once

namespace twin {

/// How blocks become segments and how far ahead the planner looks.
struct PathSettings {
  double chord_error = 0.01;          ///< delta_max of the bi-chord test; the fitted curve stays this close to the
                                      ///< polygon [mm]
  int min_segments = 3;               ///< fewest short blocks that make a curve
  int max_segments = 20;              ///< most short blocks in one curve
  double short_block_length = 10.0;   ///< a longer block is never a short block [mm]
  int look_ahead = 200;               ///< segments the planner looks at before it commits to a feedrate
};

}  // namespace twin
