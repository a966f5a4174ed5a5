#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// Direction in which an ascent goes along the path.
enum class Sense : std::int8_t { kForward = 1, kBackward = -1 };

/// The fastest rise of the feedrate from an anchor under limits that grow along the way.
///
///   limit          .--------                x  distance from the anchor
///              .---|  /                     p = v + a^2 / (2 J)
///          .---|--/'
///        __|-/'|     -J so that the corner of a step is just touched, there +J again:
///      -'                a > 0 at each step
///
/// The limit of the ascent at a place is the largest zone limit between the anchor and that place.
/// So the limits form a staircase that never falls. lower() can take a part of it down. The
/// acceleration rises with jerk +J, stays at A, and falls with jerk -J.
///
/// With jerk -J from now on, the acceleration would reach 0 at the feedrate p. The acceleration may
/// rise as long as this way out keeps the feedrate under every step. This rule is safe, because
/// jerk -J up to p and then the constant feedrate p is a motion that keeps all limits. It also
/// gives the fastest rise: at the first place where any other motion differs, the other one is
/// slower.
///
/// p never falls along the way, since dp/dt = a (1 + j / J) >= 0. So for every feedrate between
/// that of the anchor and the highest limit there is exactly one place where jerk -J has to begin
/// for the ascent to end at this feedrate.
///
/// The phases are computed one by one with extend(), only as far as they are needed. A descent to
/// an anchor is an ascent from the anchor, backward in time and along the path.
class Ascent {
 public:
  /// Begins an ascent, with no phase yet.
  /// @param zones    limits along the way from the anchor on, in path order
  /// @param first    index of the zone next to the anchor; a backward ascent goes from it to zone 0
  /// @param ceiling  highest limit of all zones [mm/s]
  void start(std::span<const LimitZone> zones, std::size_t first, const Anchor& anchor, Sense sense,
             const RampLimits& ramp, double ceiling);

  /// Computes the next phase or phases; does nothing once the ascent is complete.
  void extend();

  /// Lowers the limits up to a distance. Phases that no longer keep them are dropped.
  /// @param x      distance from the anchor [mm]
  /// @param limit  [mm/s]
  void lower(double x, double limit);

  /// The phases computed so far; their s is the distance x from the anchor.
  const std::vector<Phase>& phases() const noexcept { return phases_; }
  /// Whether the highest limit is reached.
  bool is_complete() const noexcept { return is_complete_; }
  /// Highest feedrate at which the ascent can be left so far: p at the end of the last phase
  /// [mm/s].
  double top() const noexcept;
  /// Distance of the end of the last phase from the anchor [mm].
  double reached() const noexcept { return at_.s; }

  /// Where -J has to begin for the ascent to end at a given feedrate.
  struct Exit {
    std::size_t phase;  ///< index of the phase; equal to the number of phases if after the last one
    double time;        ///< time into that phase [s]
    PathMotion at;      ///< motion where -J begins
    double distance;    ///< distance at which the feedrate is reached, with a = 0 [mm]
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
