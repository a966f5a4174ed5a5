#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "config/binding.hpp"
#include "config/find_file.hpp"
#include "config/machine_file.hpp"
#include "config/nearest_name.hpp"
#include "library/inside.hpp"

namespace twin {
namespace {

/// The error of a setting without the name of the command line's option.
Error without_option(Error error) {
  for (const std::string_view option : {"--set ", "after --set: "}) {
    if (error.message.starts_with(option)) {
      error.message.erase(0, option.size());
    }
  }
  return error;
}

/// What to do with the setting of a key; the bindings point into a copy of the machine.
template <class Use>
auto use_setting(const config::MachineFile& machine, std::string_view key, const Use& use) {
  config::MachineFile copy = machine;
  const std::vector<config::Binding> list = config::bindings(copy);
  const auto found = std::ranges::find_if(list, [&](const config::Binding& binding) {
    const std::size_t dot = binding.section.size();
    return key.starts_with(binding.section) && key.substr(dot).starts_with('.') &&
           binding.is_called(key.substr(dot + 1));
  });
  if (found == list.end()) {
    std::vector<std::string> names;
    for (const config::Binding& binding : list) {
      names.push_back(binding.path());
    }
    throw Failure({ErrorCode::kUsage,
                   fmt::format("unknown key {}{}", key, config::did_you_mean(key, names)),
                   {},
                   0,
                   0});
  }
  return use(*found);
}

}  // namespace

Settings Inside::settings(config::MachineFile machine) {
  return Settings(std::make_unique<Settings::Data>(Settings::Data{std::move(machine)}));
}

Settings::Settings(std::unique_ptr<Data> data) : data_(std::move(data)) {}

Settings::Settings(const std::string& name)
    : data_(std::make_unique<Data>(
          Data{value_of(config::read_machine_file(value_of(config::find_machine(name)), {}))})) {}

Settings::Settings(const Settings& other) : data_(std::make_unique<Data>(*other.data_)) {}
Settings& Settings::operator=(const Settings& other) { return *this = Settings(other); }
Settings::Settings(Settings&&) noexcept = default;
Settings& Settings::operator=(Settings&&) noexcept = default;
Settings::~Settings() = default;

Settings& Settings::set(const std::string& assignment) {
  config::MachineFile changed = data_->machine;
  const auto done = config::apply_overrides(changed, std::span(&assignment, 1));
  if (!done) {
    throw Failure(without_option(done.error()));
  }
  data_->machine = std::move(changed);
  return *this;
}

Settings& Settings::set(const std::string& key, double value) {
  return set(fmt::format("{}={}", key, value));
}

double Settings::number(std::string_view key) const {
  return use_setting(data_->machine, key, [&](const config::Binding& binding) {
    if (const auto* const real = std::get_if<double*>(&binding.target)) {
      return **real * binding.per_base;
    }
    if (const auto* const whole = std::get_if<int*>(&binding.target)) {
      return static_cast<double>(**whole);
    }
    throw Failure({ErrorCode::kUsage,
                   fmt::format("{} is no number: {}", key, config::value_text(binding)),
                   {},
                   0,
                   0});
  });
}

std::string Settings::text(std::string_view key) const {
  return use_setting(data_->machine, key, [](const config::Binding& binding) {
    std::string text = config::value_text(binding);
    const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
    return is_quoted ? text.substr(1, text.size() - 2) : text;
  });
}

std::vector<std::string> Settings::keys() const {
  config::MachineFile copy = data_->machine;
  std::vector<std::string> keys;
  for (const config::Binding& binding : config::bindings(copy)) {
    keys.push_back(binding.path());
  }
  return keys;
}

std::string Settings::name() const { return data_->machine.name; }
std::string Settings::toml() const { return config::to_toml(data_->machine); }
std::vector<std::string> Settings::notes() const { return data_->machine.notes; }

}  // namespace twin
