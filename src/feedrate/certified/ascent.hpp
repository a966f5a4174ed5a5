#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// Sense in which an ascent goes along the path.
enum class Sense : std::int8_t { kForward = 1, kBackward = -1 };

/// The fastest rise of the feedrate from an anchor under limits that grow along the way.
///
///   limit          .--------                x  distance from the anchor
///              .---|  /                     p = v + a^2 / (2 J)
///          .---|--/'
///        __|-/'|     -J so that the corner of a step is just touched, there +J again:
///      -'                a > 0 at each step
///
/// The limits are a staircase that never falls: at each place the largest limit between the anchor
/// and the place, less what `lower` took off. The acceleration rises with J as long as it may,
/// stays at A, and falls with -J.
///
/// If the jerk is -J from now on, the acceleration ends at 0 with the feedrate p. The acceleration
/// may rise as long as this way out would keep the feedrate under every step. That is safe, for -J
/// to p and p from then on is a motion that keeps all limits. And it is the fastest rise: no other
/// motion is ahead of it in feedrate at the first place where the two differ.
///
/// p never falls along the way (dp/dt = a (1 + j / J) >= 0). So for every feedrate between that of
/// the anchor and the last limit there is one place where the ascent has to be left to end at it.
///
/// The ascent is found event by event, as far as it is asked for. A descent to an anchor is the
/// ascent from it, backward in time and path.
class Ascent {
 public:
  /// @param zones    cover the way from the anchor on, in path order
  /// @param first    the zone on the anchor's side; a backward ascent goes from it to zone 0
  /// @param ceiling  no zone has a higher limit [mm/s]
  void start(std::span<const LimitZone> zones, std::size_t first, const Anchor& anchor, Sense sense,
             const RampLimits& ramp, double ceiling);

  /// Goes on to the next event; does nothing once it is complete.
  void extend();

  /// Clamps the feedrate to a limit [mm/s] up to the distance x [mm].
  void lower(double x, double limit);

  /// Its phases so far; their s is the distance x.
  const std::vector<Phase>& phases() const noexcept { return phases_; }
  /// Whether the highest limit is reached.
  bool is_complete() const noexcept { return is_complete_; }
  /// The highest feedrate at which it can be left so far: p at the last phase's end [mm/s].
  double top() const noexcept;
  /// Distance of the last phase's end [mm].
  double reached() const noexcept { return at_.s; }

  /// Where -J has to begin for the ascent to end at a given feedrate.
  struct Exit {
    std::size_t phase;  ///< index of the phase; the number of phases after the last one
    double time;        ///< into that phase [s]
    PathMotion at;      ///< motion there
    double distance;    ///< where the feedrate is reached, with a = 0 [mm]
  };
  /// @param v  from the anchor's feedrate to top() [mm/s]
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
  double origin_ = 0.0;        // place of the anchor [mm]
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
  PathMotion at_{};           // end of the last phase
};

}  // namespace twin::feedrate
