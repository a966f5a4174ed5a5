#include "studies/tune/varied_key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "config/nearest_name.hpp"

namespace twin::studies::tune {
namespace {

/// The whole text as a finite number, or not a number.
double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value) ? value : std::nan("");
}

/// A range of some ratios around the value of a machine; of a value that is 0, one from 0 to
/// `instead`.
VariedKey around(const config::MachineFile& machine, const std::string& key, double low,
                 double high, double instead) {
  const double value = number_of(machine, key).value_or(0.0);
  return value > 0.0 ? VariedKey{key, low * value, high * value, true}
                     : VariedKey{key, 0.0, instead, false};
}

}  // namespace

double VariedKey::value(double place) const {
  return is_logarithmic ? from * std::pow(to / from, place) : from + place * (to - from);
}

double VariedKey::place(double value) const {
  return is_logarithmic ? std::log(value / from) / std::log(to / from)
                        : (value - from) / (to - from);
}

Expected<VariedKey> parse_varied_key(std::string_view text) {
  const auto wrong = [text](const char* what) {
    return fail(
        ErrorCode::kUsage,
        fmt::format("--vary {}: {}; expected SECTION.KEY=FROM:TO or SECTION.KEY=FROM:TO:log", text,
                    what));
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    return wrong("there is no range");
  }
  std::string range(text.substr(equals + 1));
  VariedKey key{.key = std::string(text.substr(0, equals))};
  if (range.ends_with(":log")) {
    key.is_logarithmic = true;
    range.resize(range.size() - 4);
  }
  const std::size_t colon = range.find(':');
  if (colon == std::string::npos) {
    return wrong("there is no range");
  }
  key.from = number(range.substr(0, colon));
  key.to = number(range.substr(colon + 1));
  if (!(key.from < key.to)) {
    return wrong("its range is not from a number to a larger one");
  }
  if (key.is_logarithmic && !(key.from > 0.0)) {
    return wrong("a logarithmic range begins above 0");
  }
  return key;
}

Expected<double> number_of(const config::MachineFile& machine, std::string_view key) {
  std::vector<std::string> names;
  for (const Setting& setting : config::settings_of(machine)) {
    names.push_back(setting.section + "." + setting.key);
    if (names.back() == key) {
      if (const double* const value = std::get_if<double>(&setting.value)) {
        return *value;
      }
      return fail(ErrorCode::kUsage, fmt::format("{} is no real number and cannot be tuned", key));
    }
  }
  return fail(ErrorCode::kUsage, fmt::format("there is no setting {}{}", key,
                                             config::did_you_mean(std::string(key), names)));
}

std::vector<VariedKey> usual_keys(const config::MachineFile& machine, Aim aim) {
  std::vector<VariedKey> keys;
  for (const std::string axis : {"servo.x.", "servo.y."}) {
    keys.push_back(around(machine, axis + "kp_per_s", 0.3, 3.0, 300.0));
    keys.push_back({axis + "kd", -0.1, 0.6, false});
    keys.push_back({axis + "kf", 0.7, 1.2, false});
    keys.push_back({axis + "ka_s", 0.0, 0.02, false});
  }
  if (aim == Aim::kTime) {
    keys.push_back(around(machine, "limits.jerk_mm_per_s3", 0.3, 3.0, 1e5));
    keys.push_back(around(machine, "planning.corner_error_mm", 0.2, 5.0, 0.05));
    keys.push_back(around(machine, "planning.circular_error_mm", 0.2, 5.0, 0.05));
    keys.push_back(around(machine, "planning.chord_error_mm", 0.2, 5.0, 0.05));
  }
  return keys;
}

}  // namespace twin::studies::tune
