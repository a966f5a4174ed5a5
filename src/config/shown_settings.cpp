#include "config/shown_settings.hpp"

#include <algorithm>
#include <set>

#include "config/binding.hpp"
#include "config/machine_file.hpp"
#include "config/toml_file.hpp"

namespace twin::config {
namespace {

/// Paths of the settings that a table and those in it give.
void collect(const toml::table& table, const std::string& section, const std::vector<Binding>& list,
             std::set<std::string>& given) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (const Binding* const binding = find_binding(list, section, name)) {
      given.insert(binding->path());
    } else if (node.is_table()) {
      collect(*node.as_table(), section.empty() ? name : section + "." + name, list, given);
    }
  }
}

}  // namespace

Expected<std::vector<ShownSetting>> shown_settings(const std::filesystem::path& file,
                                                   std::span<const std::string> overrides) {
  TWIN_TRY(MachineFile machine, read_machine_file(file, overrides));
  TWIN_TRY(const std::string text, read_text(file));
  TWIN_TRY(const toml::table toml, parse_toml(text, file.string()));
  const std::vector<Binding> list = bindings(machine);
  std::set<std::string> in_file;
  collect(toml, "", list, in_file);
  std::set<std::string> changed;
  for (const std::string& change : overrides) {
    const std::string path = change.substr(0, change.find('='));
    const std::size_t dot = path.rfind('.');
    if (dot != std::string::npos) {
      const std::string section = path.substr(path.find_first_not_of(' '), dot);
      const std::string name = path.substr(dot + 1, path.find_last_not_of(' ') - dot);
      if (const Binding* const binding = find_binding(list, section, name)) {
        changed.insert(binding->path());
      }
    }
  }
  std::vector<ShownSetting> settings;
  for (const Binding& binding : list) {
    const std::string path = binding.path();
    settings.push_back({binding.section, binding.key(), value_text(binding), range_text(binding),
                        std::string(binding.doc),
                        changed.contains(path)   ? "--set"
                        : in_file.contains(path) ? file.filename().string()
                                                 : "built in"});
  }
  return settings;
}

}  // namespace twin::config
