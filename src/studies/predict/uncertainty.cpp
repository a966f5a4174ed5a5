#include "studies/predict/uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <random>
#include <system_error>
#include <utility>

#include "config/binding.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"

namespace twin::studies::predict {
namespace {

/// A key of [table.x] and [table.y], and the share of [uncertainty] that it has.
struct Kind {
  std::string_view key;
  double config::UncertaintySettings::*share;
};

using config::UncertaintySettings;
constexpr std::array<Kind, 9> kKinds{{
    {"moving_mass_kg", &UncertaintySettings::inertia},
    {"coulomb_friction_N", &UncertaintySettings::friction},
    {"viscous_friction_N_s_per_m", &UncertaintySettings::friction},
    {"bristle_stiffness_N_per_um", &UncertaintySettings::friction},
    {"velocity_gain_Hz", &UncertaintySettings::loop_gain},
    {"integral_time_ms", &UncertaintySettings::loop_gain},
    {"current_lag_ms", &UncertaintySettings::delay},
    {"output_delay_ms", &UncertaintySettings::delay},
    {"vref_offset_mV", &UncertaintySettings::offset},
}};

/// Deviations that twin identify has found for this machine file, by key.
Expected<std::map<std::string, double>> measured_deviations(const config::MachineFile& machine) {
  std::map<std::string, double> found;
  const std::filesystem::path file = machine.file.parent_path() / "identify.json";
  std::error_code ignored;
  if (machine.file.empty() || !std::filesystem::exists(file, ignored)) {
    return found;
  }
  TWIN_TRY(const std::string text, read_whole_file(file));
  const Json json = parse_json(text);
  const auto refuse = [&file](const std::string& why) {
    return tl::unexpected(Error{ErrorCode::kFile, why, file.string(), 0, 0});
  };
  if (!json.is_object() || !json.contains("axis") || !json["axis"].is_object()) {
    return refuse("this is not what twin identify writes; remove it or identify again");
  }
  const std::string* const of = text_in(json, "machine_file");
  if (of == nullptr || std::filesystem::path(*of).filename() != machine.file.filename()) {
    return found;  // of another machine file in the same folder
  }
  for (const auto& axis : json["axis"]) {
    if (!axis.is_object() || !axis.contains("parameters") || !axis["parameters"].is_array()) {
      continue;
    }
    for (const auto& parameter : axis["parameters"]) {
      const bool is_whole = parameter.is_object() && parameter.contains("key") &&
                            parameter["key"].is_string() && parameter.contains("sigma") &&
                            parameter["sigma"].is_number() && parameter.contains("verdict");
      if (is_whole && parameter["verdict"] == "identified") {
        found[parameter["key"].get<std::string>()] = parameter["sigma"].get<double>();
      }
    }
  }
  return found;
}

/// Numbers of one generator, the same on every platform.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t index)
      : engine_(seed * 0x9E3779B97F4A7C15ULL + index * 0xD1B54A32D192ED03ULL + 1) {
    engine_.discard(8);
  }
  /// Evenly in [0, 1).
  double even() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  /// Normal, by Box and Muller, within three deviations.
  double normal() {
    for (;;) {
      const double radius = std::sqrt(-2.0 * std::log(1.0 - even()));
      const double value = radius * std::cos(2.0 * std::numbers::pi * even());
      if (std::abs(value) <= 3.0) {
        return value;
      }
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

Expected<Uncertainty> Uncertainty::of(const config::MachineFile& machine) {
  TWIN_TRY(const auto measured, measured_deviations(machine));
  config::MachineFile copy = machine;
  const std::vector<config::Binding> list = config::bindings(copy);
  std::vector<identify::Parameter> parameters;
  std::vector<double> deviations;
  std::size_t of_file = 0;
  for (const std::string section : {"table.x", "table.y"}) {
    for (const Kind& kind : kKinds) {
      const config::Binding* const binding = config::find_binding(list, section, kind.key);
      double* const* const value = std::get_if<double*>(&binding->target);
      const double now = **value * binding->per_base;
      const auto found = measured.find(binding->path());
      const double deviation =
          found != measured.end() ? found->second : std::abs(now) * machine.uncertainty.*kind.share;
      of_file += found != measured.end() ? 1 : 0;
      if (deviation > 0.0 && binding->min < binding->max) {
        parameters.push_back({binding->path(), binding->min, binding->max});
        deviations.push_back(deviation);
      }
    }
  }
  std::vector<std::string> keys;
  for (const identify::Parameter& parameter : parameters) {
    keys.push_back(parameter.key);
  }
  TWIN_TRY(auto set, identify::ParameterSet::create(std::move(parameters)));
  Uncertainty uncertainty(machine, std::move(set));
  uncertainty.keys_ = std::move(keys);
  uncertainty.deviations_ = std::move(deviations);
  uncertainty.measured_ = of_file;
  return uncertainty;
}

PossibleMachine Uncertainty::draw(std::uint64_t seed, std::uint64_t index) const {
  Draws draws(seed, index);
  std::vector<double> values = parameters_.values(machine_);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double moved = values[i] + deviations_[i] * draws.normal();
    // Mass, friction and gains keep their sign.
    values[i] = keys_[i].ends_with("mV") ? moved : std::max(moved, 0.05 * std::abs(values[i]));
  }
  PossibleMachine possible;
  possible.machine = parameters_.with_values(machine_, values);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    possible.phases.encoder[axis] = draws.even();
    possible.phases.hum[axis] = 2.0 * std::numbers::pi * draws.even();
  }
  return possible;
}

}  // namespace twin::studies::predict
