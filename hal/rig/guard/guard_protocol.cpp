#include "hal/rig/guard/guard_protocol.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace twin::hal::rig::guard {
namespace {

constexpr const char* kPage = "--page";
constexpr const char* kLifeline = "--lifeline";
constexpr const char* kOutputs = "--outputs";
constexpr const char* kSafeDigital = "--safe-digital";
constexpr const char* kTimeout = "--timeout-ms";
constexpr std::array kFlags{kPage, kLifeline, kOutputs, kSafeDigital, kTimeout};

/// The value of each flag, in the order of kFlags.
using FlagValues = std::array<std::optional<std::string_view>, kFlags.size()>;

Expected<FlagValues> values_of(std::span<const char* const> texts) {
  FlagValues values;
  for (std::size_t i = 0; i < texts.size(); i += 2) {
    const std::string_view flag = texts[i];
    std::size_t known = 0;
    while (known < kFlags.size() && flag != kFlags[known]) {
      ++known;
    }
    if (known == kFlags.size()) {
      return fail(ErrorCode::kUsage, fmt::format("\"{}\" is no flag of twin-guard", flag));
    }
    if (i + 1 == texts.size()) {
      return fail(ErrorCode::kUsage, fmt::format("{} has no value", flag));
    }
    if (values[known]) {
      return fail(ErrorCode::kUsage, fmt::format("{} is given twice", flag));
    }
    values[known] = texts[i + 1];
  }
  for (std::size_t i = 0; i < kFlags.size(); ++i) {
    if (!values[i]) {
      return fail(ErrorCode::kUsage, fmt::format("{} is missing", kFlags[i]));
    }
  }
  return values;
}

Expected<std::int64_t> whole_number(const char* flag, std::string_view text, std::int64_t max) {
  std::int64_t value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0 || value > max) {
    return fail(ErrorCode::kUsage,
                fmt::format("{} is \"{}\", not a whole number from 0 to {}", flag, text, max));
  }
  return value;
}

}  // namespace

std::vector<std::string> to_text(const GuardArguments& arguments) {
  return {kPage,        std::to_string(arguments.page),
          kLifeline,    std::to_string(arguments.lifeline),
          kOutputs,     arguments.outputs,
          kSafeDigital, std::to_string(arguments.safe_digital),
          kTimeout,     std::to_string(arguments.timeout_ms)};
}

Expected<GuardArguments> parse_guard_arguments(std::span<const char* const> texts) {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  TWIN_TRY(const FlagValues values, values_of(texts));
  TWIN_TRY(const std::int64_t page, whole_number(kPage, *values[0], kMost));
  TWIN_TRY(const std::int64_t lifeline, whole_number(kLifeline, *values[1], kMost));
  TWIN_TRY(const std::int64_t safe_digital, whole_number(kSafeDigital, *values[3], 0xFFFF));
  TWIN_TRY(const std::int64_t timeout, whole_number(kTimeout, *values[4], kMost));
  return GuardArguments{.page = static_cast<int>(page),
                        .lifeline = static_cast<int>(lifeline),
                        .outputs = std::string(*values[2]),
                        .safe_digital = static_cast<unsigned>(safe_digital),
                        .timeout_ms = static_cast<int>(timeout)};
}

}  // namespace twin::hal::rig::guard
