#include "config/machine_file.hpp"

#include <set>
#include <utility>

#include "config/binding.hpp"
#include "config/nearest_name.hpp"
#include "config/rules.hpp"
#include "config/toml_file.hpp"

namespace twin::config {
namespace {

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

tl::unexpected<Error> refuse(std::string_view text, const std::string& why) {
  return fail(ErrorCode::kUsage, "--set " + std::string(text) + ": " + why);
}

// The value as TOML has it, or the bare text where that is no TOML.
Expected<Value> parse_value(std::string_view text) {
  const auto toml = parse_toml("value = " + std::string(text), "");
  if (!toml || toml->size() != 1) {
    return Value{std::string(text)};
  }
  return value_of(*toml->get("value"));
}

/// Applies one override. @returns path of the setting
Expected<std::string> assign_override(MachineFile& machine, std::string_view text) {
  const auto equals = text.find('=');
  const std::string_view path = trim(text.substr(0, equals));
  const auto dot = path.rfind('.');
  if (equals == std::string_view::npos || dot == std::string_view::npos) {
    return refuse(text, "wants section.key=value, as in limits.jerk_mm_per_s3=50000");
  }
  const std::vector<Binding> list = bindings(machine);
  const std::string_view section = path.substr(0, dot);
  const Binding* binding = find_binding(list, section, path.substr(dot + 1));
  if (binding == nullptr) {
    std::vector<std::string> names;
    for (const Binding& b : list) {
      names.push_back(b.path());
      names.push_back(b.section + "." + b.name);
    }
    return refuse(text, "unknown key " + std::string(path) + did_you_mean(path, names));
  }
  const auto value = parse_value(trim(text.substr(equals + 1)));
  if (!value) {
    return refuse(text, value.error().message);
  }
  if (const auto done = assign(*binding, *value); !done) {
    return refuse(text, done.error().message);
  }
  machine.add_note(renaming_note(*binding, section));
  return binding->path();
}

}  // namespace

Expected<void> apply_override(MachineFile& machine, std::string_view text) {
  TWIN_CHECK(assign_override(machine, text));
  return {};
}

Expected<void> apply_overrides(MachineFile& machine, std::span<const std::string> texts) {
  std::set<std::string> given;
  for (const std::string& text : texts) {
    TWIN_TRY(std::string path, assign_override(machine, text));
    given.insert(std::move(path));
  }
  auto fits = check_rules(machine).and_then([&] { return resolve_planner(machine, given); });
  if (!fits) {
    fits.error().code = ErrorCode::kUsage;
    fits.error().message = "after --set: " + fits.error().message;
  }
  return fits;
}

}  // namespace twin::config
