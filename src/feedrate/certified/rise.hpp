#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "feedrate/profile/phases.hpp"

namespace twin::feedrate {

/// A rise of the feedrate from an anchor, phase by phase, as fast as the limits along the way let
/// it.
///
/// It can be left at every feedrate p between that of the anchor and top(): at some place of the
/// rise jerk -J begins, and lasts until there is no acceleration. This is its way out. With p the
/// place where the way out ends moves on along the path. A descent to an anchor is a rise from the
/// anchor, backward in time and along the path.
///
/// Ascent has one A and one J, ZoneAscent those of the zones that it passes.
class Rise {
 public:
  /// Where the way out to a given feedrate begins.
  struct Exit {
    std::size_t phase;  ///< index of the phase; equal to the number of phases if after the last one
    double time;        ///< time into that phase [s]
    PathMotion at;      ///< motion where -J begins
    double distance;    ///< distance at which the feedrate is reached, with a = 0 [mm]
    /// Derivative of that distance by the feedrate; NaN where it is not known [s].
    double slope = std::numeric_limits<double>::quiet_NaN();
  };

  virtual ~Rise() = default;

  /// Computes the next phase or phases; does nothing once the rise is complete.
  virtual void extend() = 0;

  /// Lowers the limits up to a distance. Phases that no longer keep them are dropped.
  /// @param x      distance from the anchor [mm]
  /// @param limit  [mm/s]
  virtual void lower(double x, double limit) = 0;

  /// Highest feedrate at which the rise can be left so far: p at the end of the last phase [mm/s].
  virtual double top() const noexcept = 0;

  /// Where the way out to a feedrate begins.
  /// @param v  from the anchor's feedrate to top() [mm/s]
  virtual Exit exit_at(double v) const noexcept = 0;

  /// Appends the phases of a way out; their s is the distance from the anchor.
  virtual void append_way_out(const Exit& exit, std::vector<Phase>& phases) const = 0;

  /// The phases computed so far; their s is the distance from the anchor.
  const std::vector<Phase>& phases() const noexcept { return phases_; }
  /// Whether the highest limit is reached.
  bool is_complete() const noexcept { return is_complete_; }
  /// Distance of the end of the last phase from the anchor [mm].
  double reached() const noexcept { return at_.s; }

 protected:
  void restart(double v) {
    phases_.clear();
    tops_.clear();
    at_ = {0.0, v, 0.0};
    is_complete_ = false;
  }

  /// Drops the phases from an exit on.
  void cut_at(const Exit& exit) {
    phases_.resize(std::min(exit.phase + 1, phases_.size()));
    tops_.resize(phases_.size());
    if (exit.phase < phases_.size()) {
      phases_.back().duration = exit.time;
      if (exit.time == 0.0) {
        phases_.pop_back();
        tops_.pop_back();
      }
    }
    at_ = exit.at;
  }

  std::vector<Phase> phases_;
  std::vector<double> tops_;  // p at the start of each phase [mm/s]
  PathMotion at_{};           // end of the last phase
  bool is_complete_ = false;
};

}  // namespace twin::feedrate
