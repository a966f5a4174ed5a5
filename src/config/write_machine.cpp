#include "config/machine_file.hpp"

#include <fmt/format.h>

#include "config/binding.hpp"

namespace twin::config {

std::string to_toml(const MachineFile& machine,
                    const std::function<std::string(const std::string&)>& comment) {
  MachineFile copy = machine;  // the bindings want something to point at
  std::string text;
  std::string section;
  for (const Binding& binding : bindings(copy)) {
    if (binding.section != section) {
      text += fmt::format("{}[{}]\n", section.empty() ? "" : "\n", binding.section);
      section = binding.section;
    }
    std::string range = range_text(binding);
    range = range.empty() ? "" : "(" + range + ")";
    std::string remark = comment ? comment(binding.path()) : std::string();
    if (remark.empty()) {
      remark = fmt::format("{}{}{}", binding.doc, binding.doc.empty() || range.empty() ? "" : " ",
                           range);
    }
    text += fmt::format("{:<46} # {}\n", binding.key() + " = " + value_text(binding), remark);
  }
  return text;
}

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
