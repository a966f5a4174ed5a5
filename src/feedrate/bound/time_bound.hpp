#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/bound/grid.hpp"
#include "feedrate/bound/jerk_bound.hpp"
#include "feedrate/limits/feedrate_rules.hpp"
#include "feedrate/planned_segment.hpp"
#include "feedrate/planner.hpp"

/// The shortest time in which a path could be traversed.
namespace twin::feedrate {

/// Lower bound of the time that a planned path takes: the time-optimal traversal of the same path
/// with the same limits of feedrate and acceleration, but with no limit of jerk. Where the jerk along
/// the path is limited and no axis has a limit of its own, JerkBound makes more of it.
///
///   q  |        cap ____            ____
///      |  _________/    \    /\    /    .  backward: the largest q from which the rest can be kept
///      | /               \__/  \__/      \ forward: as fast as that allows
///      |/________________________________\ s
///
/// Along the path, with q = v^2 and the tangential acceleration u = 1/2 dq/ds, all limits are
/// linear: q <= V^2, |u| <= A and, where an axis i has a limit of its own, |T_i u + K_i q| <= A_i
/// with T = dC/ds and K = d2C/ds2. On a grid, a pass backward finds for each place the largest q
/// from which all later limits can be kept, and a pass forward follows the largest q that can be
/// reached below it: H. Pham, Q.-C. Pham, "A new approach to time-optimal path parameterization
/// based on reachability analysis", IEEE Transactions on Robotics, 2018. Their linear programs have
/// two unknowns here and are solved in closed form (reach.hpp).
///
/// V is the smallest of three limits: that of the planner's own rules (FeedrateRules), that of the
/// planner for each corner, and 0 where the path stops. Dwells add their time.
///
/// Segments are held until the segments that follow can no longer change their time. That is so up
/// to a place where two passes backward from the last segment give the same q: one that ends at
/// rest and one that ends at the cap. If they meet nowhere within kMostSegments, the faster one is
/// used for half of the segments, which keeps the bound below the optimum.
///
/// The grid of each such stretch is halved until the time changes by less than 0.03 %. Without
/// limits of axes every grid gives a lower bound, which rises to the optimum as the grid becomes
/// finer. With limits of axes u has to be constant over a cell, which costs time. The time then
/// falls as the grid becomes finer, by half as much with each halving, so the last fall is
/// subtracted once more.
class TimeBound {
 public:
  static constexpr std::size_t kWindow = 256;         ///< segments that are processed together
  static constexpr std::size_t kMostSegments = 8192;  ///< segments that are held at most

  /// Receives the time-optimal motion, place by place.
  /// @param s  distance along the path [mm]
  /// @param v  feedrate of the time-optimal motion there [mm/s]
  using Profile = std::function<void(double s, double v)>;

  /// @param period   interpolation period [s]
  /// @param profile  if given, called for each place of the grid, in path order
  TimeBound(const Limits& limits, const PlanningModel& model, const PathSettings& path,
            double period, Profile profile = {});

  /// Takes the next segment of the plan.
  void add(const feedrate::PlannedSegment& planned);

  /// Ends the path, at rest.
  /// @returns lower bound of the time of all segments, without a limit of jerk [s]
  double finish();

  /// Lower bound of the time of all segments with the limit of jerk, once finish() has returned; the
  /// same as without one where it is not known [s].
  double with_jerk() const noexcept { return std::max(time_, with_jerk_); }

 private:
  /// A segment whose time may still depend on the segments that follow.
  struct OpenSegment {
    path::Segment segment;         // its geometry
    std::vector<LimitZone> zones;  // of the planner
    double end_cap = kNoCap;       // largest q at its end
  };

  /// The grid over the open segments and the passes on it.
  struct Pass {
    std::vector<Cell> cells;
    std::vector<std::size_t> first;  // first cell of each segment, then the number of cells
    std::vector<double> node;        // largest q at each place; after the pass backward, that from
                                     // which later limits can be kept
  };

  void release(Tail tail);
  void make_grid(std::size_t segments, const Fineness& fineness, Pass& pass) const;
  static void run_backward(double end, Pass& pass);
  double time_until(std::size_t segment, Pass& pass) const;
  std::size_t final_segments(Pass& pass) const;
  template <class Take>
  void for_places(std::size_t segment, const Pass& pass, const Take& take) const;
  void report(std::size_t segment, const Pass& pass);

  Limits limits_;
  feedrate::FeedrateRules rules_;
  Profile profile_;
  std::deque<OpenSegment> open_;
  std::size_t next_look_ = kWindow;  // number of open segments at which release() is tried again
  double start_ = 0.0;               // q at the start of the first open segment
  double time_ = 0.0;                // time of the segments released so far [s]
  double dwell_ = 0.0;               // time of the dwells among it [s]
  std::optional<JerkBound> jerk_bound_;
  double with_jerk_ = 0.0;
  double s_ = 0.0;  // length of the segments released so far [mm]
};

}  // namespace twin::feedrate
