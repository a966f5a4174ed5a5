#include "studies/identify/candidates.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <tuple>
#include <utility>

#include "config/nearest_name.hpp"
#include "hal/mujoco/table_settings.hpp"
#include "studies/identify/parameter.hpp"

namespace twin::studies::identify {
namespace {

using When = Candidate::When;
constexpr Scale kLinear = Scale::kLinear;
constexpr Scale kLog = Scale::kLogarithmic;

/// A candidate without its axis. Ranges of 0 to 0 depend on the machine.
struct CandidateRow {
  const char* section;  // "table" or "servo"
  const char* key;
  double min;
  double max;
  Scale scale;
  const char* name;
  int hold_rank;
  When when = When::kAlways;
  double natural = 0.0;
};

constexpr std::array kLines{
    CandidateRow{"table", "moving_mass_kg", 0, 0, kLog, "moving mass", 0},
    CandidateRow{"table", "coulomb_friction_N", 0.1, 1000, kLog, "Coulomb friction", 12},
    CandidateRow{"table", "static_friction_ratio", 1, 4, kLinear, "static / Coulomb friction", 7},
    CandidateRow{"table", "stribeck_velocity_mm_per_s", 0.1, 50, kLog, "Stribeck velocity", 4},
    CandidateRow{"table", "bristle_stiffness_N_per_um", 1e-3, 1000, kLog, "bristle stiffness", 6},
    CandidateRow{"table", "bristle_damping_N_s_per_m", 0, 2e4, kLinear, "bristle damping", 3,
                 When::kAlways, 1.0},
    CandidateRow{"table", "viscous_friction_N_s_per_m", 0, 0, kLinear, "viscous friction", 5,
                 When::kAlways, 1.0},
    CandidateRow{"table", "velocity_gain_Hz", 0, 0, kLog, "velocity loop gain", 13},
    CandidateRow{"table", "integral_time_ms", 0.5, 2000, kLog, "velocity loop integral time", 11},
    CandidateRow{"table", "current_lag_ms", 0, 3, kLinear, "current loop lag", 2, When::kAlways,
                 0.05},
    CandidateRow{"table", "output_delay_ms", 0, 0, kLinear, "output delay", 9, When::kAlways, 0.05},
    CandidateRow{"table", "vref_scale_rpm_per_V", 0, 0, kLinear, "V-REF scale", 8,
                 When::kWithVolts},
    CandidateRow{"table", "vref_offset_mV", -300, 300, kLinear, "V-REF offset", 14, When::kAlways,
                 4},
    CandidateRow{"table", "hum_amplitude_mV", 0, 300, kLinear, "hum amplitude", 15},
    CandidateRow{"table", "hum_frequency_Hz", 5, 450, kLinear, "hum frequency", 16},
    CandidateRow{"table", "hum_phase_deg", -360, 360, kLinear, "hum phase", 17, When::kAlways, 90},
    CandidateRow{"servo", "kp_per_s", 5, 1000, kLog, "position gain Kp", 18, When::kWithoutVolts},
    CandidateRow{"servo", "kf", -1.5, 1.5, kLinear, "velocity feedforward Kf", 19,
                 When::kWithoutVolts},
    CandidateRow{"servo", "ka_s", -0.01, 0.01, kLinear, "acceleration feedforward Ka", 10,
                 When::kWithoutVolts, 4e-4},
    CandidateRow{"table", "screw_stiffness_N_per_um", 0, 0, kLog, "screw stiffness", 8,
                 When::kWithTable},
    CandidateRow{"table", "screw_damping_N_s_per_m", 0, 2e4, kLinear, "screw damping", 1,
                 When::kWithTable, 100.0},
    CandidateRow{"table", "screw_backlash_um", 0, 500, kLinear, "screw backlash", 9,
                 When::kWithTable, 1.0}};

constexpr double kMostViscous = 170.0;     // over the mass [N s/m/kg]
constexpr double kUsualMass = 12.0;        // of a light axis [kg]
constexpr double kMostDelayPeriods = 3.0;  // of the output; 6 ms where rows are 2 ms apart
constexpr double kUsualPeriod = 1e-3;      // [s]

/// Largest velocity loop gain that the physics step bears, with a margin [Hz].
double most_gain(const config::MachineFile& machine) {
  const double step =
      machine.period / hal::mujoco::steps_per_period(machine.period, machine.table.physics_step);
  return 0.9 / (2.0 * std::numbers::pi * std::max(step, machine.table.physics_step));
}

/// Stiffness of a screw that the physics step bears: (omega h)^2 = 2 of rotor and slide [N/um].
double most_stiffness(const config::MachineFile& machine, hal::Axis axis) {
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  const double step =
      machine.period / hal::mujoco::steps_per_period(machine.period, machine.table.physics_step);
  const double inverse = 1.0 / params.rotor_mass() + 1.0 / params.moving_mass;  // [1/kg]
  return std::max(2.0 / (inverse * step * step) * 1e-6, 1.0);
}

/// Keys of everything that a fit can change.
std::vector<std::string> known_keys(const config::MachineFile& machine) {
  std::vector<std::string> known;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    for (const Candidate& candidate : axis_candidates(machine, axis)) {
      known.push_back(candidate.parameter.key);
    }
    const std::string name = axis == hal::kX ? "x" : "y";
    known.push_back("servo." + name + ".kd");
    known.push_back("servo." + name + ".trim_V");
    known.push_back("table." + name + ".weight_N");
    known.push_back("table." + name + ".viscous_asymmetry_N_s_per_m");
    known.push_back("table." + name + ".encoder_um_per_count");
  }
  return known;
}

}  // namespace

std::string table_section(hal::Axis axis) { return axis == hal::kX ? "table.x." : "table.y."; }

std::vector<Candidate> axis_candidates(const config::MachineFile& machine, hal::Axis axis) {
  const double mass = machine.table.axis[axis].moving_mass;
  const double scale = machine.table.axis[axis].drive.vref_scale_rpm_per_V;
  std::vector<Candidate> candidates;
  for (const CandidateRow& line : kLines) {
    const std::string_view key = line.key;
    double min = line.min;
    double max = line.max;
    if (key.starts_with("moving_mass")) {
      min = std::max(0.05 * mass, 0.1);
      max = std::min(20.0 * mass, 1e4);
    } else if (key.starts_with("viscous_friction")) {
      max = kMostViscous * std::max(mass, kUsualMass);
    } else if (key.starts_with("output_delay")) {
      max = kMostDelayPeriods * std::max(machine.period, kUsualPeriod) * 1e3;
    } else if (key.starts_with("velocity_gain")) {
      min = 1.0;
      max = most_gain(machine);
    } else if (key.starts_with("screw_stiffness")) {
      min = 0.5;
      max = most_stiffness(machine, axis);
    } else if (key.starts_with("vref_scale")) {
      std::tie(min, max) = std::minmax({0.5 * scale, 2.0 * scale});
    }
    Candidate candidate;
    candidate.parameter.key = std::string(line.section) + (axis == hal::kX ? ".x." : ".y.");
    candidate.parameter.key += line.key;
    candidate.parameter.min = min;
    candidate.parameter.max = max;
    candidate.parameter.scale = line.scale;
    candidate.name = line.name;
    candidate.hold_rank = line.hold_rank;
    candidate.when = line.when;
    candidate.natural = line.natural;
    candidate.is_analysed_only = line.hold_rank == 0;
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

Expected<std::vector<std::string>> full_keys(const std::vector<std::string>& names,
                                             const config::MachineFile& machine) {
  const std::vector<std::string> known = known_keys(machine);
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    const auto found = std::ranges::find_if(
        known, [&](const std::string& key) { return key == name || key.starts_with(name + "_"); });
    if (found == known.end()) {
      return fail(ErrorCode::kUsage, name + " is nothing that a trace is fitted for" +
                                         config::did_you_mean(name, known));
    }
    keys.push_back(*found);
  }
  return keys;
}

}  // namespace twin::studies::identify
