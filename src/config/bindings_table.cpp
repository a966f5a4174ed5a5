#include <array>

#include "config/binding.hpp"
#include "hal/mujoco/table_settings.hpp"

// The settings of the simulated table, from the table's own list of them.
namespace twin::config {
namespace {

// Units that keys of the table end in; of two that fit the longer is meant.
constexpr std::array<std::string_view, 19> kUnits{
    "N_m_per_A", "N_m_per_V", "N_per_V", "um_per_count", "rpm_per_V", "N_s_per_m", "N_per_um",
    "mm_per_s",  "kg_m2",     "counts",  "N_m",          "deg",       "ms",        "mV",
    "Hz",        "kg",        "mm",      "um",           "N"};

Binding binding_of(const std::string& section, const hal::mujoco::Setting& setting) {
  Binding binding{section, std::string(setting.key), "", setting.value, setting.min, setting.max,
                  ""};
  binding.per_base = 1.0 / setting.to_base;
  for (const std::string_view unit : kUnits) {
    if (setting.key.ends_with(unit) && setting.key[setting.key.size() - unit.size() - 1] == '_') {
      binding.name.resize(setting.key.size() - unit.size() - 1);
      binding.unit = unit;
      break;
    }
  }
  return binding;
}

void add_axis(std::vector<Binding>& list, const std::string& section,
              hal::mujoco::AxisParams& axis) {
  list.push_back({section, "dac_bits", "", &axis.dac_bits, hal::mujoco::kMinDacBits,
                  hal::mujoco::kMaxDacBits, "resolution of the D/A converter over +-10 V"});
  list.push_back({section, "drive_mode", "", choice(axis.drive.mode, {"speed", "torque"}), 0.0, 0.0,
                  "what the drive makes of V-REF"});
  list.push_back({section, "encoder_at", "", choice(axis.encoder.place, {"motor", "table"}), 0.0,
                  0.0, "what the encoder measures"});
  list.push_back({section, "friction_law", "",
                  choice(axis.friction.law, {"lugre", "coulomb", "maxwell"}), 0.0, 0.0,
                  "how friction follows from the motion"});
  for (const hal::mujoco::Setting& setting : hal::mujoco::axis_settings(axis)) {
    list.push_back(binding_of(section, setting));
  }
}

}  // namespace

std::vector<Binding> table_bindings(hal::mujoco::TableParams& table) {
  std::vector<Binding> list;
  list.push_back({"table", "model", "", &table.model, 1.0, 0.0,
                  "MJCF file, beside this one or in the program's folder mjcf"});
  list.push_back({"table", "identified", "", &table.is_identified, 0.0, 0.0,
                  "whether its numbers were found on the machine that they stand for"});
  for (const hal::mujoco::Setting& setting : hal::mujoco::table_settings(table)) {
    list.push_back(binding_of("table", setting));
  }
  add_axis(list, "table.x", table.axis[hal::kX]);
  add_axis(list, "table.y", table.axis[hal::kY]);
  return list;
}

}  // namespace twin::config
