#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/bound/grid.hpp"
#include "feedrate/limits/feedrate_rules.hpp"
#include "feedrate/planned_segment.hpp"
#include "feedrate/planner.hpp"

/// How fast a path could be traversed at best.
namespace twin::feedrate {

/// Lower bound of the time that a planned path takes: the time-optimal traversal of the same path
/// with the same limits of feedrate and acceleration, but with no limit of jerk.
///
///   q  |        cap ____            ____
///      |  _________/    \    /\    /    .  backward: the largest q from which the rest can be kept
///      | /               \__/  \__/      \ forward: as fast as that allows
///      |/________________________________\ s
///
/// Along the path, with q = v^2 and the tangential acceleration u = 1/2 dq/ds, all limits are
/// linear: q <= V^2, |u| <= A and, where an axis i has a limit of its own, |T_i u + K_i q| <= A_i
/// with T = dC/ds and K = d2C/ds2. On a grid one pass backward finds the largest controllable q of
/// each place, one forward takes the largest that is reachable: H. Pham, Q.-C. Pham, "A new
/// approach to time-optimal path parameterization based on reachability analysis", IEEE
/// Transactions on Robotics, 2018. Their linear programs have two unknowns here and are solved by
/// hand (reach.hpp).
///
/// V is the limit of the planner's own rules (FeedrateRules), the limit that the planner has for
/// each corner, and 0 where it stops; dwells add their time.
///
/// Segments are kept until nothing that follows can change the result up to there: a pass backward
/// from rest and one from the cap agree. The grid of each such stretch is halved until its time
/// changes by less than 0.03 %. Without limits of axes every grid gives a lower bound, and the
/// bounds of finer grids rise to the optimum. With them u has to be constant over a cell, which is
/// slower than need be: there the times of finer grids fall, by half as much with each halving, and
/// the last fall is taken off once more. Where the two passes do not agree within kMostSegments,
/// the faster one is taken, which keeps the bound below the optimum.
class TimeBound {
 public:
  static constexpr std::size_t kWindow = 256;         ///< segments looked at together
  static constexpr std::size_t kMostSegments = 8192;  ///< segments kept at most

  /// @param s  distance along the path [mm]
  /// @param v  largest feedrate there [mm/s]
  using Profile = std::function<void(double s, double v)>;

  /// @param period   interpolation period [s]
  /// @param profile  gets the optimum's feedrate at the places of the grid, in order
  TimeBound(const Limits& limits, const PlanningModel& model, const PathSettings& path,
            double period, Profile profile = {});

  /// Takes the next segment of the plan.
  void add(const feedrate::PlannedSegment& planned);

  /// Ends the path, at rest.
  /// @returns lower bound of the time [s]
  double finish();

 private:
  /// A segment whose time may still depend on what follows.
  struct OpenSegment {
    path::Segment segment;    // its geometry
    double end_cap = kNoCap;  // largest q at its end
  };

  /// The grid over the open segments and the passes on it.
  struct Pass {
    std::vector<Cell> cells;
    std::vector<std::size_t> first;  // cell of each segment, and one past the last
    std::vector<double> node;        // largest q of each place; after the pass, controllable
  };

  void release(Tail tail);
  void make_grid(std::size_t segments, const Fineness& fineness, Pass& pass) const;
  static void run_backward(double end, Pass& pass);
  double time_until(std::size_t segment, Pass& pass) const;
  std::size_t final_segments(Pass& pass) const;
  void report(std::size_t segment, const Pass& pass);

  Limits limits_;
  feedrate::FeedrateRules rules_;
  Profile profile_;
  std::deque<OpenSegment> open_;
  std::size_t next_look_ = kWindow;  // segments at which the next stretch is looked for
  double start_ = 0.0;               // q at the begin of the first segment
  double time_ = 0.0;                // of what is released [s]
  double s_ = 0.0;                   // length of what is released [mm]
};

}  // namespace twin::feedrate
