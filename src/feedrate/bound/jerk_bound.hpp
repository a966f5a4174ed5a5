#pragma once

#include <vector>

#include "feedrate/bound/jerk_leg.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// Lower bound of the time of a path that knows the limit of jerk as well.
///
///   v |   ____           ____
///     |  /    \    /\   /    .     v: the time-optimal feedrate without a limit of jerk
///     | /      \__/  \_/      \    *: anchors, where it is lowest
///     |/       *  *   *        \ s    between them: legs
///
/// No motion is faster anywhere than the time-optimal one without a limit of jerk. So its valleys are
/// places, the anchors, at which the feedrate is at most known. Between two of them, on a leg, no more
/// is asked for than that the feedrate stays below its highest value there and that A and J are kept:
/// shortest_time() is the shortest time of that in closed form. It depends on the accelerations at
/// both anchors, which the legs beside an anchor share. The range of the acceleration at an anchor,
/// |a| <= sqrt(2 J v) where the feedrate must not become negative, is divided into cells, and beside
/// short legs that of the feedrate as well. A leg takes the best value of the cell at each of its
/// ends, and dynamic programming finds the cheapest row of cells. So the result is below the time of
/// every motion, and it is near to the shortest one where legs are straight: there nothing else is
/// given away but the width of the cells.
///
/// A leg never counts for less than its time without a limit of jerk, which knows all limits on it.
class JerkBound {
 public:
  explicit JerkBound(const RampLimits& ramp) : ramp_(ramp) {}

  /// Takes the next place of the time-optimal motion without a limit of jerk.
  /// @param s     distance along the path, no less than the last one [mm]
  /// @param v     feedrate of that motion, linear in v^2 or constant since the last place [mm/s]
  /// @param time  of that motion since the last place [s]
  void add(double s, double v, double time);

  /// Ends the path, at rest. @returns the lower bound of the time of all places [s]
  double finish();

 private:
  struct Place {
    double s;     // [mm]
    double v;     // [mm/s]
    double time;  // of the motion without a limit of jerk, since the path's begin [s]
  };

  /// Motions at an anchor that count as one.
  struct Cell {
    double v;      // their highest feedrate [mm/s]
    double least;  // their accelerations [mm/s^2]
    double most;
    double cost;  // least time up to there [s]
  };

  static std::vector<Cell> cells_at(double v, double cap, bool is_short, const RampLimits& ramp);
  void take_valley();
  void pass_leg(const Place& to, double cap, bool is_valley = false);

  RampLimits ramp_;
  std::vector<Place> lows_;  // of the valley at hand: its lowest places so far, in path order
  bool is_falling_ = false;  // into that valley
  double peak_ = 0.0;        // highest feedrate since the anchor [mm/s]
  Place last_{};             // latest place
  Place anchor_{};           // begin of the leg
  std::vector<Cell> cells_;  // of the motion there
  bool is_short_ = false;    // the leg to it is too short for its highest feedrate
};

}  // namespace twin::feedrate
