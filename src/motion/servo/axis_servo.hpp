#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/motion_settings.hpp"

/// The position loop of one axis, and the scaling between the wires (counts, volts) and the loop
/// (mm, mm/s).
namespace twin::motion {

inline constexpr double kMaxVolts = 10.0;  ///< largest drive command either way [V]

/// Position that encoder counts mean [mm]. @param mm_per_count encoder scale, signed [mm/count]
constexpr double position_from_counts(std::int64_t counts, double mm_per_count) noexcept {
  return static_cast<double>(counts) * mm_per_count;
}

/// Drive command for a velocity [V], not limited.
/// @param velocity           command velocity [mm/s]
/// @param mm_per_s_per_volt  V-REF scale of the drive, signed, not zero [mm/s/V]
constexpr double volts_from_velocity(double velocity, double mm_per_s_per_volt) noexcept {
  return velocity / mm_per_s_per_volt;
}

/// Set point of one axis at one instant.
struct Reference {
  double position = 0.0;      ///< [mm]
  double velocity = 0.0;      ///< [mm/s]
  double acceleration = 0.0;  ///< [mm/s^2]
};

/// Position loop of one axis: PD on the error plus feedforward of velocity and acceleration.
///
/// With the error e_k = r_k - y_k (set point less measured) of period k, the command velocity is
///   u_k = Kp e_k + Kd (e_k - e_{k-1}) / T + Kf v_k + Ka a_k - Kv w_k                [mm/s]
/// and the drive command is
///   V_k = clamp(u_k / s + V_trim, -10 V, +10 V),   s: V-REF scale [mm/s/V].
/// The derivative is the backward difference over one period, 0 in the first period after reset().
/// The measured velocity is w_k = (y_k - y_{k-n}) / (n T) over n periods, or over as many as there
/// were since reset(). With a command delay, r, v and a are those of so long ago, between two
/// periods on a straight line.
///
/// There is no integral term, so nothing winds up while the command is clamped: the drive's
/// velocity loop has its own.
///
/// Kf = 1 and Ka equal to the delay between command and motion (half a period of the zero-order
/// hold and the lags of output and drive) make the error of a smooth set point vanish to second
/// order.
class AxisServo {
 public:
  /// @param gains              gains of this axis
  /// @param mm_per_s_per_volt  V-REF scale s, signed, not zero [mm/s/V]
  /// @param period             interpolation period T > 0 [s]
  AxisServo(const Gains& gains, double mm_per_s_per_volt, double period) noexcept;

  /// Drive command of this period [V], within +-10 V. Real-time safe.
  /// @param measured  measured position [mm]
  double update(const Reference& reference, double measured) noexcept;

  /// Makes a motion that goes on the past of the first update(). Real-time safe.
  /// @param reference  set point one period ago  @param measured  position one period ago [mm]
  /// @param velocity   of both until then [mm/s]
  void begin_moving(const Reference& reference, double measured, double velocity) noexcept;
  /// Forgets the last error, as after a change of the set point by hand. Real-time safe.
  void reset() noexcept;

  /// True if the last command was cut to +-10 V.
  bool is_saturated() const noexcept { return is_saturated_; }
  /// Set point less measured at the last update() [mm].
  double error() const noexcept { return last_error_; }

 private:
  static constexpr std::size_t kMostDelay = 512;  // of the command, in periods

  Reference delayed(const Reference& reference) noexcept;
  double measured_velocity(double measured) noexcept;

  Gains gains_;
  double mm_per_s_per_volt_;
  double rate_;  // 1 / period [1/s]
  double last_error_ = 0.0;
  std::size_t delay_;                             // whole periods of the command delay
  double delay_part_;                             // and the rest, 0 to 1 [periods]
  std::array<Reference, kMostDelay> commands_{};  // the latest ones, in a ring
  std::size_t commands_seen_ = 0;
  std::array<double, kMostVelocityPeriods> measured_{};  // the latest ones, newest first
  int measured_seen_ = 0;
  bool has_last_ = false;
  bool is_saturated_ = false;
};

}  // namespace twin::motion
