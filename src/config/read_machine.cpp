#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "config/binding.hpp"
#include "config/find_file.hpp"
#include "config/machine_file.hpp"
#include "config/nearest_name.hpp"
#include "config/rules.hpp"
#include "config/toml_file.hpp"

namespace twin::config {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::string& section, const std::string& name) {
  return section.empty() ? name : fmt::format("{}.{}", section, name);
}

/// Takes the keys of a parsed file one by one.
class Reader {
 public:
  Reader(MachineFile& machine, std::string file)
      : machine_(machine), list_(bindings(machine)), file_(std::move(file)) {}

  /// @param section  dotted name of the table, empty for the whole file
  Expected<void> read(const toml::table& table, const std::string& section) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      const std::string path = joined(section, name);
      TWIN_CHECK(node.is_table() && is_section(path) ? read(*node.as_table(), path)
                                                     : read_key(section, name, node, key.source()));
    }
    return {};
  }

 private:
  bool is_section(const std::string& path) const {
    return std::any_of(list_.begin(), list_.end(), [&](const Binding& b) {
      return b.section == path || b.section.starts_with(path + ".");
    });
  }

  Expected<void> read_key(const std::string& section, const std::string& name,
                          const toml::node& node, const toml::source_region& place) {
    const Binding* binding = find_binding(list_, section, name);
    if (binding == nullptr) {
      return at(place,
                node.is_table() ? unknown_section(section, name) : unknown_key(section, name));
    }
    if (!seen_.insert(binding->path()).second) {
      return at(place, binding->path() + " is given twice, under two of its names");
    }
    const auto value = value_of(node);
    if (!value) {
      return at(node.source(), binding->path() + " is " + value.error().message);
    }
    if (const auto assigned = assign(*binding, *value); !assigned) {
      return at(node.source(), assigned.error().message);
    }
    machine_.add_note(renaming_note(*binding, section));
    return {};
  }

  std::string unknown_section(const std::string& section, const std::string& name) const {
    std::vector<std::string> names;
    std::ranges::transform(list_, std::back_inserter(names), &Binding::section);
    const std::string path = joined(section, name);
    return "unknown section [" + path + "]" + did_you_mean(path, names);
  }

  std::string unknown_key(const std::string& section, const std::string& name) const {
    if (section.empty()) {
      return "unknown key " + name + " outside of any section";
    }
    std::vector<std::string> names;
    for (const Binding& b : list_) {
      if (b.section == section) {
        names.push_back(b.key());
      }
    }
    return "unknown key " + name + " in [" + section + "]" + did_you_mean(name, names);
  }

  tl::unexpected<Error> at(const toml::source_region& place, std::string message) const {
    return tl::unexpected<Error>(Error{ErrorCode::kFile, std::move(message), file_,
                                       static_cast<int>(place.begin.line),
                                       static_cast<int>(place.begin.column)});
  }

  MachineFile& machine_;
  std::vector<Binding> list_;
  std::string file_;
  std::set<std::string> seen_;
};

/// The model of a machine file: beside the file, or where that has none, of the same name in a folder
/// mjcf of the program, so that a copied machine file works anywhere. @returns an absolute path
std::string find_model(const fs::path& folder, const std::string& name) {
  const fs::path beside = fs::absolute(folder / name).lexically_normal();
  std::error_code error;
  if (!fs::exists(beside, error)) {
    for (const fs::path& own : data_folders("mjcf")) {
      if (fs::exists(own / name, error)) {
        return fs::absolute(own / name).lexically_normal().string();
      }
    }
  }
  return beside.string();
}

}  // namespace

void MachineFile::add_note(std::string note) {
  if (!note.empty() && std::ranges::find(notes, note) == notes.end()) {
    notes.push_back(std::move(note));
  }
}

Expected<MachineFile> parse_machine_file(std::string_view text, const fs::path& file,
                                         std::span<const std::string> overrides) {
  TWIN_TRY(const toml::table toml, parse_toml(text, file.string()));
  MachineFile machine;
  machine.file = file;
  machine.table.model = "xy_table.xml";
  machine.name = file.stem().string();
  TWIN_CHECK(Reader(machine, file.string()).read(toml, ""));
  if (auto fits = check_rules(machine); !fits) {
    fits.error().file = file.string();
    return tl::unexpected(fits.error());
  }
  TWIN_CHECK(apply_overrides(machine, overrides));
  machine.table.model = find_model(file.parent_path(), machine.table.model);
  return machine;
}

Expected<MachineFile> read_machine_file(const fs::path& file,
                                        std::span<const std::string> overrides) {
  TWIN_TRY(const std::string text, read_text(file));
  return parse_machine_file(text, file, overrides);
}

}  // namespace twin::config
