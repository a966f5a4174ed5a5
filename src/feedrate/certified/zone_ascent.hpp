#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "feedrate/certified/ascent.hpp"
#include "feedrate/limits/zones.hpp"

namespace twin::feedrate {

/// The rise of the feedrate from an anchor where each zone has its own A and J.
///
///   J      -----.      .------           x  distance from the anchor
///               '------'                 way out: -J of each place, until a = 0
///   a       /\      /\.
///         /'  '----'   '\__
///
/// In each zone the acceleration rises with the jerk J of the zone, stays at its A, and falls with
/// -J. A is a staircase over the feedrate (ramp_levels.hpp). The acceleration may rise as long as its
/// way out keeps the limits: from there on -J of each place that is passed, until a = 0, with a within
/// A and the feedrate within the limit at every place. Limits are those of Ascent: the largest zone
/// limit since the anchor.
///
/// The rule is safe, because a way out that keeps all limits is there at every place. Where A and J
/// are the same everywhere, the result is that of Ascent, but for rounding. The places where -J
/// begins are roots of the excess of the way out over the limits, so a zone costs some ten ways out
/// where a limit is touched, and one elsewhere.
class ZoneAscent final : public Rise {
 public:
  /// Begins a rise, with no phase yet. The parameters are those of Ascent::start(); no zone allows
  /// more than `ramp`.
  void start(std::span<const LimitZone> zones, std::size_t first, const Anchor& anchor, Sense sense,
             const RampLimits& ramp, double ceiling);

  void extend() override;
  void lower(double x, double limit) override;
  double top() const noexcept override { return top_; }
  Exit exit_at(double v) const noexcept override;
  void append_way_out(const Exit& exit, std::vector<Phase>& phases) const override;

 private:
  /// A stretch of the way with one limit, one J and one staircase of A.
  struct Cell {
    double end;  // distance from the anchor [mm]
    double limit;
    double jerk;
    std::size_t level;  // its first level
  };

  /// The end of a way out.
  struct WayOut {
    double v;       // [mm/s]
    double s;       // distance from the anchor [mm]
    double excess;  // by which it exceeds some limit, as a share of it; 0 or less: none is exceeded
    bool is_beyond;  // it ends beyond the cells that are known
  };

  void load_cell();
  std::size_t cell_at(double s) const noexcept;
  std::size_t level_at(const Cell& cell, double v) const noexcept;
  double excess_over_levels(const Cell& cell, const PathMotion& at, double v_end) const noexcept;
  template <class Take>
  WayOut follow_way_out(PathMotion at, double most_excess, const Take& take) const noexcept;
  WayOut way_out(const PathMotion& at) const noexcept;
  double excess_of(const PathMotion& at);
  double longest(const Phase& phase, const Cell& cell, const RampLevel& level) const noexcept;
  double last_safe(const Phase& phase, double time, double excess);
  void append(double duration, double jerk);
  void leave(const Cell& cell);
  void hold(const Cell& cell);

  std::span<const LimitZone> zones_;
  std::size_t next_zone_ = 0;  // not yet part of cells_
  std::size_t count_ = 0;      // zones that are left
  double origin_ = 0.0;        // place of the anchor [mm]
  double sign_ = 1.0;
  RampLimits ramp_{};
  double ceiling_ = 0.0;
  double highest_ = 0.0;  // limit of the last cell [mm/s]
  double top_ = 0.0;      // p at at_ [mm/s]
  std::vector<Cell> cells_;
  std::vector<RampLevel> levels_;
};

}  // namespace twin::feedrate
