#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "hal/machine.hpp"
#include "hal/mujoco/change.hpp"

/// Every number of the simulated table, with units. The values are those of mjcf/xy_table.toml;
/// where each comes from is said in mjcf/README.md.
namespace twin::hal::mujoco {

/// Servo motor on the ball screw (SGMAH-02A).
struct MotorParams {
  double rotor_inertia = 1.06e-5;  ///< [kg m^2]
  double torque_constant = 0.327;  ///< [N.m/A]
  double peak_torque = 1.91;       ///< torque limit either way [N.m]
  double current_lag = 0.45e-3;    ///< time constant of the current loop, 0: none [s]
};

/// What the drive makes of its command.
enum class DriveMode : std::uint8_t {
  kSpeed,   ///< V-REF is a speed, which the drive's velocity loop follows
  kTorque,  ///< V-REF is a torque; the loop of the speed is in the controller's servo
};

/// Drive between its terminals and the motor's torque.
struct DriveParams {
  DriveMode mode = DriveMode::kSpeed;
  double vref_scale_rpm_per_V = 500.0;  ///< speed per volt of V-REF, signed [rpm/V]
  double torque_scale = 0.0;  ///< torque mode: torque per volt, signed; 0: force_scale says [N.m/V]
  double force_scale = 0.0;   ///< torque mode: the same as force at the slide, signed [N/V]
  double input_lag = 0.0;     ///< time constant of the V-REF input filter, 0: none [s]
  double output_delay = 0.3e-3;       ///< from write() to the drive seeing the voltage [s]
  double velocity_gain_Hz = 30.0;     ///< velocity loop gain, referred to the total inertia [Hz]
  double integral_time = 7e-3;        ///< of the velocity loop, 0: no integral part [s]
  double velocity_loop_period = 0.0;  ///< between its samples, 0: every physics step [s]
  double speed_filter = 0.0;          ///< time constant of the speed feedback's filter [s]
  double speed_delay = 0.0;           ///< dead time of the speed feedback [s]
  double vref_offset = 0.0;           ///< constant disturbance of V-REF [V]
  double hum_amplitude = 20e-3;       ///< peak of the mains hum on V-REF [V]
  double hum_frequency_Hz = 60.0;     ///< [Hz]
  double hum_phase = 0.0;             ///< at the first physics step [rad]
  double ready_delay = 20e-3;         ///< from /S-ON to /S-RDY and torque [s]
  double overload_time = 0.5;         ///< alarm after so long at the torque limit [s]
};

/// How friction follows from the motion.
enum class FrictionLaw : std::uint8_t {
  kLugre,    ///< one bristle with Stribeck curve and elastic zone
  kCoulomb,  ///< one spring that slips at the Coulomb friction
  kMaxwell,  ///< generalised Maxwell slip: springs side by side that slip one after the other
};

/// Friction of the slide.
struct FrictionParams {
  FrictionLaw law = FrictionLaw::kLugre;
  double coulomb = 8.0;              ///< Coulomb friction Fc, mean of both directions [N]
  double static_ratio = 1.5;         ///< breakaway over Coulomb friction Fs / Fc >= 1 [-]
  double stribeck_velocity = 2.0;    ///< vs [mm/s]
  double bristle_stiffness = 300.0;  ///< s0 [N/mm]
  double bristle_damping = 0.44;     ///< s1 [N s/mm]
  double viscous = 0.01;             ///< s2, mean of both directions [N s/mm]
  double elastic_share = 0.9;      ///< purely elastic part of the Coulomb deflection, 0: LuGre [-]
  double coulomb_asymmetry = 0.0;  ///< Fc + this towards plus, Fc - this towards minus [N]
  double viscous_asymmetry = 0.0;  ///< s2 + this towards plus, s2 - this towards minus [N s/mm]

  /// Coulomb friction in the direction of a velocity [N].
  double coulomb_at(double velocity) const noexcept {
    return velocity < 0.0 ? coulomb - coulomb_asymmetry : coulomb + coulomb_asymmetry;
  }
  /// Viscous friction in the direction of a velocity [N s/mm].
  double viscous_at(double velocity) const noexcept {
    return velocity < 0.0 ? viscous - viscous_asymmetry : viscous + viscous_asymmetry;
  }
};

/// Forces on the slide that depend on where it is.
struct LoadParams {
  double weight = 0.0;                 ///< constant force towards minus, signed [N]
  double ripple_amplitude = 0.0;       ///< torque ripple as force at the slide [N]
  double ripple_per_revolution = 1.0;  ///< its periods in a revolution of the screw [-]
  double ripple_phase = 0.0;           ///< at position 0 [rad]
};

/// Ball screw. All but the lead is used by the compliant model only.
struct ScrewParams {
  double lead = 10.0;       ///< travel per revolution [mm]
  double stiffness = 60e3;  ///< between motor and slide [N/mm]
  double damping = 4.0;     ///< the same [N s/mm]
  double backlash = 0.0;    ///< play between screw and nut [mm]
};

/// Where an axis is measured.
enum class EncoderPlace : std::uint8_t {
  kMotor,  ///< the motor's angle as travel
  kTable,  ///< the slide: a scale
};

/// Incremental encoder.
struct EncoderParams {
  EncoderPlace place = EncoderPlace::kMotor;
  double mm_per_count = 0.010;  ///< after fourfold evaluation, signed [mm/count]
  double phase = 0.5;           ///< where in a count the zero lies, 0 <= phase < 1 [counts]
  double delay = 0.0;           ///< from the position to the controller reading it [s]
};

/// One servo axis of the table.
struct AxisParams {
  double moving_mass = 12.0;  ///< everything that this axis moves, without the rotor [kg]
  double travel = 210.0;      ///< limit switches at -travel and +travel [mm]
  int dac_bits = 16;          ///< resolution of the D/A converter over +-10 V [bit]
  MotorParams motor;
  DriveParams drive;
  FrictionParams friction;
  LoadParams load;
  ScrewParams screw;
  EncoderParams encoder;

  /// Motor torque per volt in torque mode, signed [N.m/V].
  double torque_per_volt() const {
    return drive.torque_scale + drive.force_scale * mm_per_rad() * 1e-3;
  }
  /// Travel per radian of the motor [mm/rad].
  double mm_per_rad() const { return screw.lead / (2.0 * std::numbers::pi); }
  /// V-REF scale as travel, signed [mm/s/V].
  double mm_per_s_per_volt() const { return drive.vref_scale_rpm_per_V / 60.0 * screw.lead; }
  /// Rotor and slide as seen by the motor, J = J_r + m (lead / 2 pi)^2 [kg m^2].
  double total_inertia() const {
    const double m_per_rad = mm_per_rad() * 1e-3;
    return motor.rotor_inertia + moving_mass * m_per_rad * m_per_rad;
  }
  /// Rotor as seen by the slide, J_r (2 pi / lead)^2 [kg].
  double rotor_mass() const {
    const double m_per_rad = mm_per_rad() * 1e-3;
    return motor.rotor_inertia / (m_per_rad * m_per_rad);
  }
};

/// The lower axis: carries the X table on its saddle.
inline AxisParams default_y_axis() {
  AxisParams axis;
  axis.moving_mass = 30.0;
  axis.friction.coulomb = 10.0;
  axis.friction.bristle_stiffness = 10e3;
  axis.friction.bristle_damping = 1.11;
  axis.drive.velocity_gain_Hz = 150.0;
  axis.drive.integral_time = 10e-3;
  return axis;
}

/// The whole table.
struct TableParams {
  /// MJCF file; xy_table_compliant.xml for screws that give.
  std::string model = "mjcf/xy_table.xml";
  bool is_identified = false;      ///< the numbers were found on the machine they stand for
  double physics_step = 1e-4;      ///< at most; a whole number of steps makes a period [s]
  double pen_bandwidth_Hz = 20.0;  ///< of the Z slide that follows its reference [Hz]
  std::array<AxisParams, kServoAxes> axis{AxisParams{}, default_y_axis()};
  std::vector<Change> changes{};  ///< what changes while it runs

  /// Whether its screws give: models that have them say "compliant" in their file's name.
  bool has_giving_screws() const {
    return model.find("compliant", model.find_last_of('/') + 1) != std::string::npos;
  }
};

}  // namespace twin::hal::mujoco
