#include "config/binding.hpp"

// The settings of homing.
namespace twin::config {

std::vector<Binding> home_bindings(MachineFile& machine) {
  std::vector<Binding> list;
  for (const std::size_t axis : {hal::kX, hal::kY}) {
    const std::string section = axis == hal::kX ? "home.x" : "home.y";
    HomeSettings& home = machine.home[axis];
    list.push_back({section, "switch", "", choice(home.is_positive, {"n-ot", "p-ot"}), 0.0, 0.0,
                    "limit switch that is sought"});
    list.push_back({section, "seek_feedrate", "mm_per_min", &home.seek_feedrate, 1.0, 6000.0,
                    "towards the switch, and to zero afterwards", 60.0});
    list.push_back({section, "index_feedrate", "mm_per_min", &home.index_feedrate, 1.0, 600.0,
                    "off the switch and to the index", 60.0});
    list.push_back(
        {section, "zero", "mm", &home.zero, -1e4, 1e4, "from the index to the axis' zero, signed"});
  }
  return list;
}

}  // namespace twin::config
