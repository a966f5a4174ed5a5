#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "feedrate/limits/limit_zone.hpp"
#include "feedrate/paper/hump.hpp"
#include "feedrate/profile/phase.hpp"
#include "feedrate/profile/ramp_limits.hpp"

namespace twin::feedrate {

/// Sense in which an ascent goes along the path.
enum class Sense : std::int8_t { kForward = 1, kBackward = -1 };

/// The fastest rise of the feedrate from a knot under limits that grow along the way.
///
///   limit          .--------                x  distance from the knot
///              .---|  /                     p = v + a^2 / (2 J)
///          .---|--/'
///        __|-/'|     -J so that the corner of a step is just touched, there +J again:
///      -'                a > 0 at each step
///
/// The limits are a staircase that never falls: the largest one between the knot and the place,
/// less what `lower` took off. The acceleration rises with J as long as it may, stays at A, and
/// falls with -J. It may rise as long as -J from then on, until a = 0 at the feedrate p, would keep
/// the feedrate under every step. That is safe, for -J to p and p from then on is a motion that
/// keeps all limits; and no motion is ahead of it in feedrate at the first place where they differ.
/// p never falls (dp/dt = a (1 + j / J) >= 0), so the ascent can be left at any feedrate p between
/// that of the knot and the last limit, at one place each. It is found event by event, as far as it
/// is asked for. A descent to a knot is the ascent from it, backward in time and path.
class Ascent {
 public:
  /// @param zones    cover the way from the knot on, in path order
  /// @param first    the zone on the knot's side; a backward ascent goes from it to zone 0
  /// @param ceiling  no zone has a higher limit [mm/s]
  void start(std::span<const LimitZone> zones, std::size_t first, const Knot& knot, Sense sense,
             const RampLimits& ramp, double ceiling);

  /// Goes on to the next event; does nothing once it is complete.
  void extend();

  /// Keeps the feedrate at or below a limit up to the distance x.
  void lower(double x, double limit);

  /// Its phases so far, of s = x.
  const std::vector<Phase>& phases() const noexcept { return phases_; }
  /// Whether the highest limit is reached.
  bool is_complete() const noexcept { return is_complete_; }
  /// Feedrate at which it can be left at the latest so far: p of the last phase's end [mm/s].
  double top() const noexcept;
  /// Distance of the last phase's end [mm].
  double reached() const noexcept { return at_.s; }

  /// Where -J has to begin to end at a feedrate.
  struct Exit {
    std::size_t phase;  ///< the last phase, or the number of all of them
    double time;        ///< of it [s]
    PathMotion at;      ///< there
    double distance;    ///< where the feedrate is reached, with a = 0 [mm]
  };
  /// @param v  from the knot's feedrate to top() [mm/s]
  Exit exit_at(double v) const noexcept;

 private:
  struct Step {
    double end;    // distance up to which the limit holds [mm]
    double limit;  // [mm/s]
  };

  double leaving_feedrate(const PathMotion& at) const noexcept;
  bool load_step();
  const Step& step(std::size_t index);
  bool keeps(const Phase& phase, double time, const Step& step) const noexcept;
  double crossing(const PathMotion& at, double limit) const noexcept;
  double longest(const Phase& phase, double limit) const noexcept;
  double touching(const Phase& phase, double time, const Step& step) const noexcept;
  void append(double duration, double jerk);
  void follow(const Step& step);

  std::span<const LimitZone> zones_;
  std::size_t next_zone_ = 0;  // not yet part of steps_
  double origin_ = 0.0;        // place of the knot [mm]
  double sign_ = 1.0;
  double a_max_ = 0.0;
  double jerk_ = 0.0;
  double ceiling_ = 0.0;
  double highest_ = 0.0;  // limit of the step under way [mm/s]
  bool has_all_steps_ = false;
  bool is_complete_ = false;
  std::vector<Step> steps_;
  std::size_t step_ = 0;  // first one that ends beyond at_
  std::vector<Phase> phases_;
  std::vector<double> tops_;  // p at the start of each phase [mm/s]
  PathMotion at_{};
};

}  // namespace twin::feedrate
