#include "config/overrides.hpp"

#include <algorithm>

#include "config/binding.hpp"
#include "config/nearest_name.hpp"
#include "config/rules.hpp"
#include "config/toml_value.hpp"

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

}  // namespace

Expected<void> apply_override(MachineFile& machine, std::string_view text) {
  const auto equals = text.find('=');
  const std::string_view path = trim(text.substr(0, equals));
  const auto dot = path.rfind('.');
  if (equals == std::string_view::npos || dot == std::string_view::npos) {
    return refuse(text, "wants section.key=value, as in limits.jerk_mm_per_s3=50000");
  }
  const std::vector<Binding> list = bindings(machine);
  const auto binding = std::find_if(list.begin(), list.end(), [&](const Binding& b) {
    return b.section == path.substr(0, dot) && b.is_called(path.substr(dot + 1));
  });
  if (binding == list.end()) {
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
  const auto done = assign(*binding, *value);
  return done ? done : refuse(text, done.error().message);
}

Expected<void> apply_overrides(MachineFile& machine, std::span<const std::string> texts) {
  for (const std::string& text : texts) {
    if (auto done = apply_override(machine, text); !done) {
      return done;
    }
  }
  auto fits = check_rules(machine);
  if (!fits) {
    fits.error().code = ErrorCode::kUsage;
    fits.error().message = "after --set: " + fits.error().message;
  }
  return fits;
}

}  // namespace twin::config
