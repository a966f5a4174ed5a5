#include "hal/mujoco/table_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace twin::hal::mujoco {
namespace {

constexpr double kMilli = 1e-3;
constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kPerMmFromPerUm = 1e3;   // stiffness: N/um in N/mm
constexpr double kPerMmFromPerM = 1e-3;   // damping: N s/m in N s/mm
constexpr double kMaxGainPerStep = 1.0;   // K h of the velocity loop; unstable from 2 on
constexpr double kWholeTolerance = 1e-6;  // how far from whole a count of steps may be

tl::unexpected<Error> out_of_range(const std::string& section, const Setting& setting) {
  return fail(ErrorCode::kMachine,
              fmt::format("{}.{} = {:g} is outside {:g} to {:g}", section, setting.key,
                          *setting.value / setting.to_base, setting.min, setting.max));
}

Expected<void> check(const std::string& section, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    const double value = *setting.value / setting.to_base;
    const double slack = 1e-9 * (std::abs(setting.min) + std::abs(setting.max));
    if (!(value >= setting.min - slack && value <= setting.max + slack)) {
      return out_of_range(section, setting);
    }
  }
  return {};
}

/// Torque mode wants one scale, speed mode none.
Expected<void> check_drive_mode(const std::string& section, const DriveParams& drive) {
  if (drive.mode == DriveMode::kTorque && drive.torque_scale == 0.0 && drive.force_scale == 0.0) {
    return fail(ErrorCode::kMachine,
                fmt::format("{0}.drive_mode = \"torque\" needs {0}.torque_scale_N_m_per_V or "
                            "{0}.force_scale_N_per_V",
                            section));
  }
  if (drive.torque_scale != 0.0 && drive.force_scale != 0.0) {
    return fail(
        ErrorCode::kMachine,
        fmt::format("{0}.torque_scale_N_m_per_V = {1:g} and {0}.force_scale_N_per_V = {2:g} "
                    "say the same twice: one of them must be 0",
                    section, drive.torque_scale, drive.force_scale));
  }
  return {};
}

Expected<void> check_axis(const std::string& section, AxisParams& axis, double step) {
  TWIN_CHECK(check(section, axis_settings(axis)));
  if (axis.dac_bits < kMinDacBits || axis.dac_bits > kMaxDacBits) {
    return fail(ErrorCode::kMachine, fmt::format("{}.dac_bits = {} is outside {} to {}", section,
                                                 axis.dac_bits, kMinDacBits, kMaxDacBits));
  }
  if (axis.encoder.mm_per_count == 0.0 || axis.drive.vref_scale_rpm_per_V == 0.0) {
    return fail(ErrorCode::kMachine,
                fmt::format("{}.encoder_um_per_count and {}.vref_scale_rpm_per_V must not be 0",
                            section, section));
  }
  TWIN_CHECK(check_drive_mode(section, axis.drive));
  if (std::abs(axis.friction.coulomb_asymmetry) > axis.friction.coulomb ||
      std::abs(axis.friction.viscous_asymmetry) > axis.friction.viscous) {
    return fail(ErrorCode::kMachine,
                fmt::format("{0}.coulomb_asymmetry_N and {0}.viscous_asymmetry_N_s_per_m must not "
                            "exceed the friction itself: it would push in one direction",
                            section));
  }
  const double gain = 2.0 * std::numbers::pi * axis.drive.velocity_gain_Hz * step;
  if (gain > kMaxGainPerStep) {
    return fail(
        ErrorCode::kMachine,
        fmt::format("{}.velocity_gain_Hz = {:g} needs table.physics_step_ms of at most {:.3g}",
                    section, axis.drive.velocity_gain_Hz, step / kMilli * kMaxGainPerStep / gain));
  }
  return {};
}

}  // namespace

std::vector<Setting> table_settings(TableParams& params) {
  return {
      {"physics_step_ms", &params.physics_step, kMilli, 1e-3, 1.0,
       "must divide the interpolation period"},
      {"pen_bandwidth_Hz", &params.pen_bandwidth_Hz, 1.0, 1.0, 100.0,
       "bandwidth of the Z slide that follows its set point"},
  };
}

std::vector<Setting> axis_settings(AxisParams& params) {
  auto& [mass, travel, bits, motor, drive, friction, load, screw, encoder] = params;
  static_cast<void>(bits);
  return {
      {"moving_mass_kg", &mass, 1.0, 0.1, 10000.0, "everything the axis moves, without the rotor"},
      {"travel_mm", &travel, 1.0, 1.0, 10000.0, "limit switches at minus and plus this"},
      {"rotor_inertia_kg_m2", &motor.rotor_inertia, 1.0, 1e-9, 1.0, "rotor inertia of the motor"},
      {"torque_constant_N_m_per_A", &motor.torque_constant, 1.0, 1e-3, 100.0, "torque per ampere"},
      {"peak_torque_N_m", &motor.peak_torque, 1.0, 1e-3, 1000.0, "torque limit either way"},
      {"current_lag_ms", &motor.current_lag, kMilli, 0.0, 100.0,
       "time constant of the current loop"},
      {"vref_scale_rpm_per_V", &drive.vref_scale_rpm_per_V, 1.0, -10000.0, 10000.0,
       "motor speed per volt of V-REF; negative turns the axis round"},
      {"input_lag_ms", &drive.input_lag, kMilli, 0.0, 100.0,
       "time constant of the V-REF input filter"},
      {"output_delay_ms", &drive.output_delay, kMilli, 0.0, 100.0,
       "from write to the drive seeing the voltage"},
      {"velocity_gain_Hz", &drive.velocity_gain_Hz, 1.0, 0.1, 20000.0,
       "velocity loop gain, referred to the total inertia"},
      {"integral_time_ms", &drive.integral_time, kMilli, 0.0, 1e6,
       "integral time of the velocity loop; 0: no integral part"},
      {"velocity_loop_period_ms", &drive.velocity_loop_period, kMilli, 0.0, 10.0,
       "of the velocity loop, with speed from encoder differences; 0: continuous"},
      {"speed_filter_ms", &drive.speed_filter, kMilli, 0.0, 100.0,
       "time constant of the filter of the speed feedback"},
      {"speed_feedback_delay_ms", &drive.speed_delay, kMilli, 0.0, 100.0,
       "dead time of the speed feedback"},
      {"torque_scale_N_m_per_V", &drive.torque_scale, 1.0, -1000.0, 1000.0,
       "torque mode: motor torque per volt"},
      {"force_scale_N_per_V", &drive.force_scale, 1.0, -1e6, 1e6,
       "torque mode: the same as force at the slide; one of the two is 0"},
      {"vref_offset_mV", &drive.vref_offset, kMilli, -1000.0, 1000.0,
       "constant disturbance of V-REF"},
      {"hum_amplitude_mV", &drive.hum_amplitude, kMilli, 0.0, 1000.0,
       "peak of the mains hum on V-REF"},
      {"hum_frequency_Hz", &drive.hum_frequency_Hz, 1.0, 0.0, 5000.0, "frequency of the hum"},
      {"hum_phase_deg", &drive.hum_phase, kRadPerDeg, -360.0, 360.0,
       "phase of the hum at the first physics step"},
      {"ready_delay_ms", &drive.ready_delay, kMilli, 0.0, 10000.0,
       "from /S-ON to /S-RDY and torque"},
      {"overload_time_ms", &drive.overload_time, kMilli, 1.0, 1e6,
       "alarm after so long at the torque limit"},
      {"coulomb_friction_N", &friction.coulomb, 1.0, 0.0, 10000.0, "Coulomb friction Fc"},
      {"static_friction_ratio", &friction.static_ratio, 1.0, 1.0, 10.0,
       "breakaway over Coulomb friction, Fs / Fc"},
      {"stribeck_velocity_mm_per_s", &friction.stribeck_velocity, 1.0, 1e-3, 1000.0,
       "Stribeck velocity vs"},
      {"bristle_stiffness_N_per_um", &friction.bristle_stiffness, kPerMmFromPerUm, 1e-4, 1000.0,
       "bristle stiffness s0"},
      {"bristle_damping_N_s_per_m", &friction.bristle_damping, kPerMmFromPerM, 0.0, 1e5,
       "bristle damping s1"},
      {"viscous_friction_N_s_per_m", &friction.viscous, kPerMmFromPerM, 0.0, 1e5,
       "viscous friction s2"},
      {"bristle_elastic_share", &friction.elastic_share, 1.0, 0.0, 0.99,
       "elastic part of the Coulomb deflection; 0 is plain LuGre"},
      {"coulomb_asymmetry_N", &friction.coulomb_asymmetry, 1.0, -10000.0, 10000.0,
       "Coulomb friction towards plus less that towards minus, halved"},
      {"viscous_asymmetry_N_s_per_m", &friction.viscous_asymmetry, kPerMmFromPerM, -1e5, 1e5,
       "viscous friction towards plus less that towards minus, halved"},
      {"weight_N", &load.weight, 1.0, -1e5, 1e5, "constant force on the slide towards minus"},
      {"ripple_amplitude_N", &load.ripple_amplitude, 1.0, 0.0, 1e4,
       "torque ripple, as force at the slide"},
      {"ripple_per_revolution", &load.ripple_per_revolution, 1.0, 0.0, 1000.0,
       "periods of the ripple in a revolution of the screw"},
      {"ripple_phase_deg", &load.ripple_phase, kRadPerDeg, -360.0, 360.0,
       "phase of the ripple at position 0"},
      {"screw_lead_mm", &screw.lead, 1.0, 0.1, 1000.0, "travel per revolution"},
      {"screw_stiffness_N_per_um", &screw.stiffness, kPerMmFromPerUm, 1e-3, 10000.0,
       "of the screw; used by xy_table_compliant.xml only"},
      {"screw_damping_N_s_per_m", &screw.damping, kPerMmFromPerM, 0.0, 1e6,
       "of the screw; used by xy_table_compliant.xml only"},
      {"screw_backlash_um", &screw.backlash, kMilli, 0.0, 1000.0,
       "play of the screw; used by xy_table_compliant.xml only"},
      {"encoder_um_per_count", &encoder.mm_per_count, kMilli, -10000.0, 10000.0,
       "encoder scale after fourfold evaluation; negative turns it round"},
      {"encoder_phase_counts", &encoder.phase, 1.0, 0.0, 1.0, "where in a count the zero lies"},
      {"feedback_delay_ms", &encoder.delay, kMilli, 0.0, 100.0,
       "from a position to the controller reading it"},
  };
}

int steps_per_period(double period, double physics_step) noexcept {
  return std::max(static_cast<int>(std::ceil(period / physics_step * (1.0 - kWholeTolerance))), 1);
}

Expected<void> validate(const TableParams& params) {
  TableParams copy = params;
  TWIN_CHECK(check("table", table_settings(copy)));
  TWIN_CHECK(check_axis("table.x", copy.axis[kX], copy.physics_step));
  TWIN_CHECK(check_axis("table.y", copy.axis[kY], copy.physics_step));
  return {};
}

}  // namespace twin::hal::mujoco
