#pragma once

#include <span>
#include <vector>

#include "feedrate/certified/rise.hpp"
#include "feedrate/limits/ramp_levels.hpp"
#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

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
/// The phases are computed one by one with extend(), only as far as they are needed.
class Ascent final : public Rise {
 public:
  /// Begins an ascent, with no phase yet.
  /// @param zones    limits along the way from the anchor on, in path order
  /// @param first    index of the zone next to the anchor; a backward ascent goes from it to zone 0
  /// @param ceiling  highest limit of all zones [mm/s]
  void start(std::span<const LimitZone> zones, std::size_t first, const Anchor& anchor, Sense sense,
             const RampLimits& ramp, double ceiling);

  void extend() override;
  void lower(double x, double limit) override;
  double top() const noexcept override;
  Exit exit_at(double v) const noexcept override;
  void append_way_out(const Exit& exit, std::vector<Phase>& phases) const override;

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
  std::size_t first_zone_ = 0;
  std::size_t next_zone_ = 0;  // not yet part of steps_
  double origin_ = 0.0;        // place of the anchor [mm]
  double sign_ = 1.0;
  double a_max_ = 0.0;
  double jerk_ = 0.0;
  double ceiling_ = 0.0;
  double highest_ = 0.0;  // limit of the step under way [mm/s]
  bool has_all_steps_ = false;
  std::vector<Step> steps_;
  std::size_t step_ = 0;  // first one that ends beyond at_
};

}  // namespace twin::feedrate
