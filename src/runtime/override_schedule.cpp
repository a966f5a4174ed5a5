#include "runtime/override_schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace twin::runtime {
namespace {

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = end == text.data() + text.size();
  return code == std::errc() && is_whole && std::isfinite(value) ? std::optional(value)
                                                                 : std::nullopt;
}

Expected<OverrideChange> parse_change(std::string_view text) {
  const auto colon = text.find(':');
  const auto time = number(text.substr(0, colon));
  const auto percent =
      colon == std::string_view::npos ? std::nullopt : number(text.substr(colon + 1));
  if (!time || !percent) {
    return fail(ErrorCode::kUsage,
                fmt::format("override '{}' is not SECONDS:PERCENT, as in 2.5:50", text));
  }
  if (*time < 0.0) {
    return fail(ErrorCode::kUsage,
                fmt::format("override '{}': {:g} s is before the first set point", text, *time));
  }
  if (*percent < 0.0 || *percent > kHighestOverride) {
    return fail(ErrorCode::kUsage, fmt::format("override '{}': {:g} % is not within 0 and {:g} %",
                                               text, *percent, kHighestOverride));
  }
  return OverrideChange{.time = *time, .percent = *percent};
}

}  // namespace

Expected<std::vector<OverrideChange>> parse_override_schedule(std::string_view text) {
  std::vector<OverrideChange> schedule;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    TWIN_TRY(const OverrideChange change, parse_change(text.substr(begin, comma - begin)));
    if (!schedule.empty() && change.time <= schedule.back().time) {
      return fail(ErrorCode::kUsage, fmt::format("override at {:g} s comes after one at {:g} s; "
                                                 "the seconds have to ascend",
                                                 change.time, schedule.back().time));
    }
    schedule.push_back(change);
    begin = comma + 1;
  }
  return schedule;
}

}  // namespace twin::runtime
