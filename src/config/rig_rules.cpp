#include "config/rig_rules.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace twin::config {
namespace {

using hal::rig::AxisWiring;

/// A channel and the key that claims it.
struct Claim {
  std::string key;
  int channel;  ///< -1: none
};

Expected<void> check_distinct(const std::string& what, const std::vector<Claim>& claims) {
  std::map<int, std::string> owners;
  for (const Claim& claim : claims) {
    if (claim.channel < 0) {
      continue;
    }
    const auto [owner, is_new] = owners.emplace(claim.channel, claim.key);
    if (!is_new) {
      return fail(ErrorCode::kFile, fmt::format("{} and {} are both {} {}", owner->second,
                                                claim.key, what, claim.channel));
    }
  }
  return {};
}

}  // namespace

Expected<void> check_rig_rules(const hal::rig::RigSettings& rig) {
  std::vector<Claim> dacs, counters, outputs, inputs, analogue;
  for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
    const AxisWiring& a = rig.axis[i];
    const std::string section = i == hal::kX ? "rig.x." : "rig.y.";
    dacs.push_back({section + "dac", a.dac});
    counters.push_back({section + "counter", a.counter});
    outputs.push_back({section + "servo_on_do", a.servo_on.channel});
    outputs.push_back({section + "alarm_reset_do", a.alarm_reset.channel});
    inputs.push_back({section + "alarm_di", a.alarm.channel});
    inputs.push_back({section + "ready_di", a.ready.channel});
    inputs.push_back({section + "limit_positive_di", a.limit_positive.channel});
    inputs.push_back({section + "limit_negative_di", a.limit_negative.channel});
    analogue.push_back({section + "vref_readback_ai", a.vref_readback});
  }
  if (rig.counter_reset_offset % 4 != 0) {
    return fail(ErrorCode::kFile, fmt::format("rig.counter_reset_offset = {} is no multiple of 4",
                                              rig.counter_reset_offset));
  }
  return check_distinct("analogue output", dacs)
      .and_then([&] { return check_distinct("counter", counters); })
      .and_then([&] { return check_distinct("digital output", outputs); })
      .and_then([&] { return check_distinct("digital input", inputs); })
      .and_then([&] { return check_distinct("analogue input", analogue); });
}

}  // namespace twin::config
