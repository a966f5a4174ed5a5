#include "hal/rig/emulator/fault.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <cmath>

#include "hal/machine.hpp"

namespace twin::hal::rig::emulator {
namespace {

// In the order of FaultKind.
constexpr std::array<std::string_view, kFaultKinds> kNames{
    "encoder_frozen", "encoder_lost_counts", "encoder_slipping", "encoder_swapped", "dac_stuck",
    "vref_reversed",  "vref_open",           "servo_on_lost",    "alarm",           "wire_broken",
    "limit_positive", "limit_negative",      "card_gone_1716",   "card_gone_1784"};

tl::unexpected<Error> wrong(std::string_view text, const std::string& what) {
  return fail(ErrorCode::kUsage,
              fmt::format("fault '{}': {}; write KIND:AXIS@SECONDS, as alarm:x@1.5 or "
                          "card_gone_1784@2, with KIND one of {}",
                          text, what, fmt::join(kNames, ", ")));
}

std::optional<FaultKind> kind_of(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) {
      return static_cast<FaultKind>(i);
    }
  }
  return std::nullopt;
}

std::optional<double> seconds_of(std::string_view text) noexcept {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  return is_number && std::isfinite(value) && value >= 0.0 ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string_view to_string(FaultKind kind) noexcept {
  return kNames[static_cast<std::size_t>(kind)];
}

bool has_axis(FaultKind kind) noexcept {
  return kind != FaultKind::kCardGone1716 && kind != FaultKind::kCardGone1784;
}

Expected<Fault> parse_fault(std::string_view text) {
  const std::size_t at = text.find('@');
  if (at == std::string_view::npos) {
    return wrong(text, "it has no time");
  }
  const std::string_view place = text.substr(0, at);
  const std::size_t colon = place.find(':');
  const std::optional<FaultKind> kind = kind_of(place.substr(0, colon));
  if (!kind) {
    return wrong(text, fmt::format("'{}' is no kind of fault", place.substr(0, colon)));
  }
  const bool names_axis = colon != std::string_view::npos;
  if (names_axis != has_axis(*kind)) {
    return wrong(text, names_axis ? "it breaks a card and takes no axis" : "it needs an axis");
  }
  Fault fault{*kind, kX, 0.0};
  if (names_axis) {
    const std::string_view axis = place.substr(colon + 1);
    if (axis != "x" && axis != "y") {
      return wrong(text, fmt::format("axis '{}' is neither x nor y", axis));
    }
    fault.axis = axis == "x" ? kX : kY;
  }
  const std::optional<double> time = seconds_of(text.substr(at + 1));
  if (!time) {
    return wrong(text, fmt::format("'{}' is no time in seconds from 0 on", text.substr(at + 1)));
  }
  fault.time = *time;
  return fault;
}

std::string to_string(const Fault& fault) {
  const std::string_view axis = fault.axis == kX ? ":x" : ":y";
  return fmt::format("{}{}@{}", to_string(fault.kind), has_axis(fault.kind) ? axis : "",
                     fault.time);
}

}  // namespace twin::hal::rig::emulator
