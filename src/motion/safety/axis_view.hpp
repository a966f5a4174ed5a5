#pragma once

#include <concepts>
#include <cstdint>
#include <optional>

#include "motion/safety/trip.hpp"

namespace twin::motion {

/// What does not change about an axis.
struct AxisFacts {
  double period = 0.001;             ///< interpolation period T [s]
  double mm_per_count = 0.001;       ///< encoder scale, signed [mm/count]
  double mm_per_s_per_volt = 100.0;  ///< V-REF scale, signed [mm/s/V]
  double feedrate = 200.0;           ///< largest feedrate of the machine [mm/s]
};

/// What a monitor sees of one axis in one period: the inputs of its begin and the drive command
/// that the servo made of them.
struct AxisView {
  double interval = 0.001;    ///< since the last view [s]: T, or more where a period was late
  double command = 0.0;       ///< set point [mm]
  double velocity = 0.0;      ///< of the set point [mm/s]
  double feedrate = 0.0;      ///< along the path [mm/s]
  double measured = 0.0;      ///< position that the counts mean [mm]
  std::int64_t counts = 0;    ///< encoder [counts]
  double volts = 0.0;         ///< drive command [V]
  bool is_saturated = false;  ///< the drive command was cut to +-10 V
  bool servo_ready = true;    ///< /S-RDY
  bool alarm = false;
  bool limit_positive = false;  ///< P-OT
  bool limit_negative = false;  ///< N-OT
};

/// True where periods before this one were missed.
constexpr bool is_late(const AxisView& view, double period) noexcept {
  return view.interval > 1.5 * period;
}

/// What a monitor found in one period.
struct Finding {
  Kind kind;
  double value;
  double limit;
};

/// A monitor of one axis: called once a period, finds something or nothing. Real-time safe.
template <class M>
concept Monitor = requires(M monitor, const AxisView& view) {
  { monitor.check(view) }
  noexcept->std::same_as<std::optional<Finding>>;
};

}  // namespace twin::motion
