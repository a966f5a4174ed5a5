#include "studies/identify/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "config/binding.hpp"
#include "config/nearest_name.hpp"

namespace twin::studies::identify {
namespace {

using config::Binding;

bool is_called(const Binding& binding, std::string_view key) {
  return key == binding.path() || key == binding.section + "." + binding.name;
}

tl::unexpected<Error> unknown(const std::string& key, const std::vector<Binding>& list) {
  std::vector<std::string> names;
  for (const Binding& binding : list) {
    names.push_back(binding.path());
  }
  return fail(ErrorCode::kUsage,
              fmt::format("unknown key {}{}", key, config::did_you_mean(key, names)));
}

Expected<void> check_range(const Parameter& p, const Binding& binding) {
  const bool has_log = p.scale == Scale::kLogarithmic;
  if (!(p.min < p.max) || (has_log && !(p.min > 0.0))) {
    return fail(ErrorCode::kUsage,
                fmt::format("{}: from {:g} to {:g} is no range to look in", p.key, p.min, p.max));
  }
  if (p.min < binding.min || p.max > binding.max) {
    return fail(ErrorCode::kUsage, fmt::format("{}: {:g} to {:g} is not inside {}", p.key, p.min,
                                               p.max, config::range_text(binding)));
  }
  return {};
}

}  // namespace

double to_unit(const Parameter& p, double value) {
  if (p.scale == Scale::kLinear) {
    return (value - p.min) / (p.max - p.min);
  }
  return value > 0.0 ? std::log(value / p.min) / std::log(p.max / p.min) : 0.0;
}

double from_unit(const Parameter& p, double unit) {
  return p.scale == Scale::kLinear ? p.min + unit * (p.max - p.min)
                                   : p.min * std::pow(p.max / p.min, unit);
}

Expected<ParameterSet> ParameterSet::create(std::vector<Parameter> parameters) {
  config::MachineFile machine;
  const std::vector<Binding> list = config::bindings(machine);
  ParameterSet set;
  for (Parameter& parameter : parameters) {
    const auto found = std::ranges::find_if(
        list, [&](const Binding& binding) { return is_called(binding, parameter.key); });
    if (found == list.end()) {
      return unknown(parameter.key, list);
    }
    if (!std::holds_alternative<double*>(found->target)) {
      return fail(ErrorCode::kUsage,
                  fmt::format("{} is not a single number and cannot be fitted", found->path()));
    }
    TWIN_CHECK(check_range(parameter, *found));
    const auto place = static_cast<std::size_t>(found - list.begin());
    if (std::ranges::find(set.bindings_, place) != set.bindings_.end()) {
      return fail(ErrorCode::kUsage, fmt::format("{} is named twice", found->path()));
    }
    parameter.key = found->path();
    set.bindings_.push_back(place);
  }
  set.parameters_ = std::move(parameters);
  return set;
}

std::vector<double> ParameterSet::values(const config::MachineFile& machine) const {
  config::MachineFile copy = machine;  // the bindings want something to point at
  const std::vector<Binding> list = config::bindings(copy);
  std::vector<double> result;
  for (const std::size_t place : bindings_) {
    result.push_back(*std::get<double*>(list[place].target) * list[place].per_base);
  }
  return result;
}

config::MachineFile ParameterSet::with_values(const config::MachineFile& machine,
                                              std::span<const double> values) const {
  assert(values.size() == size());
  config::MachineFile copy = machine;
  const std::vector<Binding> list = config::bindings(copy);
  for (std::size_t i = 0; i < size(); ++i) {
    const Binding& binding = list[bindings_[i]];
    *std::get<double*>(binding.target) =
        std::clamp(values[i], binding.min, binding.max) / binding.per_base;
  }
  return copy;
}

std::vector<double> ParameterSet::units(const config::MachineFile& machine) const {
  std::vector<double> result = values(machine);
  for (std::size_t i = 0; i < size(); ++i) {
    result[i] = std::clamp(to_unit(parameters_[i], result[i]), 0.0, 1.0);
  }
  return result;
}

config::MachineFile ParameterSet::with_units(const config::MachineFile& machine,
                                             std::span<const double> units) const {
  assert(units.size() == size());
  std::vector<double> values;
  for (std::size_t i = 0; i < size(); ++i) {
    values.push_back(from_unit(parameters_[i], std::clamp(units[i], 0.0, 1.0)));
  }
  return with_values(machine, values);
}

}  // namespace twin::studies::identify
