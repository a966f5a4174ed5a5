#include "studies/reproduce/table_parameters.hpp"

#include <string>

namespace twin::studies::reproduce {

std::vector<studies::identify::Parameter> table_parameters() {
  using studies::identify::Scale;
  std::vector<studies::identify::Parameter> list;
  for (const std::string axis : {"x", "y"}) {
    const std::string table = "table." + axis + ".";
    list.push_back({table + "coulomb_friction_N", 0.5, 80.0, Scale::kLogarithmic});
    list.push_back({table + "static_friction_ratio", 1.0, 2.5, Scale::kLinear});
    list.push_back({table + "stribeck_velocity_mm_per_s", 0.3, 20.0, Scale::kLogarithmic});
    list.push_back({table + "bristle_stiffness_N_per_um", 0.03, 30.0, Scale::kLogarithmic});
    list.push_back({table + "bristle_damping_N_s_per_m", 20.0, 3000.0, Scale::kLogarithmic});
    list.push_back({table + "viscous_friction_N_s_per_m", 0.5, 60.0, Scale::kLogarithmic});
    list.push_back({table + "velocity_gain_Hz", 15.0, 300.0, Scale::kLogarithmic});
    list.push_back({table + "integral_time_ms", 1.0, 30.0, Scale::kLogarithmic});
    list.push_back({table + "current_lag_ms", 0.1, 1.0, Scale::kLinear});
    list.push_back({table + "output_delay_ms", 0.05, 1.0, Scale::kLinear});
    list.push_back({table + "encoder_um_per_count", 0.5, 16.0, Scale::kLogarithmic});
    list.push_back({table + "hum_amplitude_mV", 0.0, 60.0, Scale::kLinear});
    list.push_back({table + "vref_offset_mV", -15.0, 15.0, Scale::kLinear});
    const std::string servo = "servo." + axis + ".";
    list.push_back({servo + "kp_per_s", 40.0, 300.0, Scale::kLogarithmic});
    list.push_back({servo + "kf", 0.97, 1.03, Scale::kLinear});
    list.push_back({servo + "ka_s", 0.0, 0.005, Scale::kLinear});
  }
  return list;
}

}  // namespace twin::studies::reproduce
