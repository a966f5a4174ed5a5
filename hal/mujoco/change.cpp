#include "hal/mujoco/change.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "hal/machine.hpp"

namespace twin::hal::mujoco {
namespace {

/// A kind of change: what it changes, and which values it may reach.
struct KindFacts {
  std::string_view name;
  double AxisCondition::*changed;
  double min;
  double max;
  double to_base;  // base unit of the condition per unit of the text
};

// In the order of ChangeKind.
constexpr std::array<KindFacts, kChangeKinds> kFacts{
    {{"friction", &AxisCondition::friction, 0.0, 100.0, 1.0},
     {"stiffness", &AxisCondition::stiffness, 0.01, 4.0, 1.0},
     {"vref_gain", &AxisCondition::vref_gain, -10.0, 10.0, 1.0},
     {"vref_offset", &AxisCondition::vref_offset, -1000.0, 1000.0, 1e-3},
     {"loop_gain", &AxisCondition::loop_gain, 0.01, 10.0, 1.0},
     {"encoder_slip", &AxisCondition::lost_share, 0.0, 1000.0, 1e-3},
     {"backlash", &AxisCondition::backlash, 0.0, 1000.0, 1e-3},
     {"load", &AxisCondition::mass, 0.0, 1000.0, 1.0},
     {"force", &AxisCondition::force, -1e5, 1e5, 1.0}}};

const KindFacts& facts_of(ChangeKind kind) noexcept {
  return kFacts[static_cast<std::size_t>(kind)];
}

tl::unexpected<Error> bad_change(std::string_view text, const std::string& what) {
  std::array<std::string_view, kChangeKinds> names{};
  std::ranges::transform(kFacts, names.begin(), &KindFacts::name);
  return fail(ErrorCode::kUsage, fmt::format("change '{}': {}; write KIND:AXIS=VALUE@SECONDS or "
                                             "KIND:AXIS=VALUE@SECONDS+RAMP, as friction:x=1.3@2 or "
                                             "vref_gain:y=0.95@1+5, with KIND one of {}",
                                             text, what, fmt::join(names, ", ")));
}

std::optional<double> number_in(std::string_view text) noexcept {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = !text.empty() && error == std::errc{} && end == text.data() + text.size();
  return is_number && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Reads "SECONDS" or "SECONDS+RAMP".
Expected<void> take_times(std::string_view text, std::string_view times, Change& change) {
  const std::size_t plus = times.find('+');
  const auto start = number_in(times.substr(0, plus));
  const auto ramp =
      plus == std::string_view::npos ? std::optional(0.0) : number_in(times.substr(plus + 1));
  if (!start || !ramp || *start < 0.0 || *ramp < 0.0) {
    return bad_change(text, fmt::format("'{}' is no time in seconds from 0 on", times));
  }
  change.start = *start;
  change.ramp = *ramp;
  return {};
}

}  // namespace

std::string_view to_string(ChangeKind kind) noexcept { return facts_of(kind).name; }

bool needs_screw(ChangeKind kind) noexcept {
  return kind == ChangeKind::kStiffness || kind == ChangeKind::kBacklash;
}

Expected<Change> parse_change(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::size_t equals = text.find('=');
  const std::size_t at = text.find('@');
  if (colon == std::string_view::npos || equals == std::string_view::npos ||
      at == std::string_view::npos || colon > equals || equals > at) {
    return bad_change(text, "it does not have an axis, a value and a time in this order");
  }
  const std::string_view name = text.substr(0, colon);
  const auto facts = std::ranges::find(kFacts, name, &KindFacts::name);
  if (facts == kFacts.end()) {
    return bad_change(text, fmt::format("'{}' is no kind of change", name));
  }
  const std::string_view axis = text.substr(colon + 1, equals - colon - 1);
  if (axis != "x" && axis != "y") {
    return bad_change(text, fmt::format("axis '{}' is neither x nor y", axis));
  }
  const std::string_view words = text.substr(equals + 1, at - equals - 1);
  const std::optional<double> value = number_in(words);
  if (!value || *value < facts->min || *value > facts->max) {
    return bad_change(
        text, fmt::format("'{}' is no value from {:g} to {:g}", words, facts->min, facts->max));
  }
  Change change;
  change.kind = static_cast<ChangeKind>(facts - kFacts.begin());
  change.axis = axis == "x" ? kX : kY;
  change.value = *value;
  TWIN_CHECK(take_times(text, text.substr(at + 1), change));
  return change;
}

std::string to_string(const Change& change) {
  std::string text = fmt::format("{}:{}={}@{}", to_string(change.kind),
                                 change.axis == kX ? "x" : "y", change.value, change.start);
  return change.ramp > 0.0 ? text + fmt::format("+{}", change.ramp) : text;
}

AxisCondition condition_at(const std::vector<Change>& changes, std::size_t axis,
                           double time) noexcept {
  AxisCondition condition;
  for (const Change& change : changes) {
    if (change.axis != axis || time < change.start) {
      continue;
    }
    const double passed = time - change.start;
    const double share = passed < change.ramp ? passed / change.ramp : 1.0;
    const KindFacts& facts = facts_of(change.kind);
    // The condition before the change: 1 of a factor, which has no other unit, or 0.
    const double before = AxisCondition{}.*facts.changed;
    condition.*facts.changed = (before + share * (change.value - before)) * facts.to_base;
  }
  return condition;
}

}  // namespace twin::hal::mujoco
