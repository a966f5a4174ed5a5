#include "config/settings.hpp"

#include "config/binding.hpp"

namespace twin::config {

std::vector<Setting> settings_of(const MachineFile& machine) {
  MachineFile copy = machine;  // the bindings want something to point at
  std::vector<Setting> settings;
  for (const Binding& binding : bindings(copy)) {
    settings.push_back(
        {.section = binding.section, .key = binding.key(), .value = setting_value(binding)});
  }
  return settings;
}

}  // namespace twin::config
