#include "shadow/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/sha256.hpp"

namespace twin::shadow {
namespace {

constexpr const char* kFormat = "twin shadow baseline 2";
constexpr std::size_t kMostCoefficients = 1000;
constexpr std::array<const char*, hal::kServoAxes> kAxisKeys{"x", "y"};

Json json_of(const PerParameter& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kParameters; ++i) {
    json[std::string(name_of(static_cast<Cause>(i)))] = values[i];
  }
  return json;
}

Json json_of(const ChannelBaseline& channel) {
  Json json;
  json["channel"] = name_of(channel.kind);
  json["windows"] = channel.windows;
  json["variance"] = channel.variance;
  json["coefficients"] = channel.coefficients;
  json["walk_um"] = channel.noise.walk;
  json["white_um"] = channel.noise.white;
  json["slow_um"] = channel.noise.slow;
  json["mean"] = json_of(channel.mean);
  json["excess"] = json_of(channel.excess);
  json["scatter"] = json_of(channel.scatter);
  json["limit"] = json_of(channel.limit);
  json["step_excess"] = channel.step_excess;
  json["force_excess"] = channel.force_excess;
  return json;
}

/// Reads members of JSON objects; the first that is not as expected is kept as the error.
class BaselineReader {
 public:
  explicit BaselineReader(const std::filesystem::path& file) : file_(file) {}

  tl::unexpected<Error> error(const std::string& message) const {
    return tl::unexpected(Error{ErrorCode::kFile, message, file_.string(), 0, 0});
  }

  double number(const Json& json, const std::string& key, double least, double most) {
    const auto at = json.is_object() ? json.find(key) : json.end();
    if (!json.is_object() || at == json.end() || !at->is_number()) {
      return wrong(key, "a number");
    }
    const double value = at->get<double>();
    return std::isfinite(value) && value >= least && value <= most
               ? value
               : wrong(key, fmt::format("a number from {:g} to {:g}", least, most));
  }

  std::string text(const Json& json, const std::string& key) {
    const auto at = json.is_object() ? json.find(key) : json.end();
    if (!json.is_object() || at == json.end() || !at->is_string()) {
      wrong(key, "a text");
      return {};
    }
    return at->get<std::string>();
  }

  const Json& member(const Json& json, const std::string& key) {
    static const Json kNothing = Json::object();
    const auto at = json.is_object() ? json.find(key) : json.end();
    if (!json.is_object() || at == json.end()) {
      wrong(key, "a value");
      return kNothing;
    }
    return *at;
  }

  PerParameter parameters(const Json& json, double least) {
    PerParameter values{};
    for (std::size_t i = 0; i < kParameters; ++i) {
      values[i] = number(json, std::string(name_of(static_cast<Cause>(i))), least, 1e9);
    }
    return values;
  }

  std::vector<double> coefficients(const Json& json) {
    std::vector<double> values;
    if (!json.is_array() || json.size() > kMostCoefficients) {
      wrong("coefficients", fmt::format("a list of at most {} numbers", kMostCoefficients));
      return values;
    }
    for (const Json& value : json) {
      values.push_back(value.is_number() ? value.get<double>() : std::nan(""));
      if (!(std::abs(values.back()) < 1e6)) {
        wrong("coefficients", "finite numbers");
      }
    }
    return values;
  }

  double wrong(const std::string& key, const std::string& expected) {
    if (wrong_.empty()) {
      wrong_ = fmt::format("'{}' should be {}", key, expected);
    }
    return 0.0;
  }

  /// What was wrong first; empty: nothing.
  const std::string& first_wrong() const { return wrong_; }

 private:
  const std::filesystem::path& file_;
  std::string wrong_;
};

ChannelBaseline read_channel(BaselineReader& reader, const Json& json) {
  ChannelBaseline channel;
  const std::string kind = reader.text(json, "channel");
  constexpr std::array kKinds{ChannelKind::kPosition, ChannelKind::kCounts, ChannelKind::kScale,
                              ChannelKind::kForce};
  const auto at =
      std::ranges::find_if(kKinds, [&kind](ChannelKind one) { return kind == name_of(one); });
  if (at == kKinds.end()) {
    reader.wrong("channel", "position, counts, scale or force");
  } else {
    channel.kind = *at;
  }
  channel.windows = static_cast<std::size_t>(reader.number(json, "windows", 0.0, 1e12));
  channel.variance = reader.number(json, "variance", 1e-15, 1e15);
  channel.coefficients = reader.coefficients(reader.member(json, "coefficients"));
  channel.noise.walk = reader.number(json, "walk_um", 1e-9, 1e9);
  channel.noise.white = reader.number(json, "white_um", 1e-9, 1e9);
  channel.noise.slow = reader.number(json, "slow_um", 0.0, 1e9);
  channel.mean = reader.parameters(reader.member(json, "mean"), -1e9);
  channel.excess = reader.parameters(reader.member(json, "excess"), 1.0);
  channel.scatter = reader.parameters(reader.member(json, "scatter"), 0.0);
  channel.limit = reader.parameters(reader.member(json, "limit"), 0.0);
  channel.step_excess = reader.number(json, "step_excess", 1.0, 1e9);
  channel.force_excess = reader.number(json, "force_excess", 1.0, 1e9);
  return channel;
}

}  // namespace

std::string_view name_of(ChannelKind kind) noexcept {
  switch (kind) {
    case ChannelKind::kPosition:
      return "position";
    case ChannelKind::kCounts:
      return "counts";
    case ChannelKind::kScale:
      return "scale";
    case ChannelKind::kForce:
      break;
  }
  return "force";
}

std::string hash_of_model(const config::MachineFile& machine) {
  config::MachineFile plain;
  plain.table = machine.table;
  plain.period = machine.period;
  plain.table.model = std::filesystem::path(machine.table.model).filename().string();
  for (hal::mujoco::AxisParams& axis : plain.table.axis) {
    axis.encoder.phase = 0.5;
    axis.drive.hum_phase = 0.0;
  }
  return sha256(config::to_toml(plain, [](const std::string&) { return std::string("-"); }));
}

Expected<void> write_baseline(const std::filesystem::path& file, const Baseline& baseline) {
  Json json;
  json["format"] = kFormat;
  json["machine"] = baseline.machine;
  json["machine_sha256"] = baseline.machine_sha256;
  json["period_s"] = baseline.period;
  json["learnt_from"] = baseline.programs;
  json["learnt_from_s"] = rounded(baseline.seconds);
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    json["axes"][kAxisKeys[axis]] = Json::array();
    for (const ChannelBaseline& channel : baseline.axis[axis]) {
      json["axes"][kAxisKeys[axis]].push_back(json_of(channel));
    }
  }
  return write_whole_file(file, to_text(json));
}

Expected<Baseline> read_baseline(const std::filesystem::path& file,
                                 const config::MachineFile& machine) {
  TWIN_TRY(const std::string text, read_whole_file(file));
  BaselineReader reader(file);
  const Json json = parse_json(text);
  if (json.is_discarded()) {
    return reader.error(
        fmt::format("this is no JSON, from byte {} on; twin shadow --learn writes "
                    "such files",
                    json_error(text)));
  }
  if (reader.text(json, "format") != kFormat) {
    return reader.error(
        fmt::format("this is no file of twin shadow --learn: 'format' should be '{}'", kFormat));
  }
  Baseline baseline;
  baseline.machine = reader.text(json, "machine");
  baseline.machine_sha256 = reader.text(json, "machine_sha256");
  baseline.period = reader.number(json, "period_s", 1e-6, 1.0);
  baseline.seconds = reader.number(json, "learnt_from_s", 0.0, 1e12);
  for (const Json& name : reader.member(json, "learnt_from")) {
    baseline.programs.push_back(name.is_string() ? name.get<std::string>() : std::string());
  }
  const Json& axes = reader.member(json, "axes");
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    for (const Json& channel : reader.member(axes, kAxisKeys[axis])) {
      baseline.axis[axis].push_back(read_channel(reader, channel));
    }
  }
  if (!reader.first_wrong().empty()) {
    return reader.error(reader.first_wrong());
  }
  if (baseline.period != machine.period) {
    return reader.error(
        fmt::format("it was learnt with a period of {} s, the machine has {} s; learn "
                    "again with twin shadow --learn",
                    baseline.period, machine.period));
  }
  if (baseline.machine_sha256 != hash_of_model(machine)) {
    return reader.error(
        fmt::format("it was learnt of another machine ({}), or with other settings of "
                    "its table, than {}; learn again with twin shadow --learn",
                    baseline.machine, machine.name));
  }
  return baseline;
}

}  // namespace twin::shadow
