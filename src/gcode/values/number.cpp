#include "gcode/values/number.hpp"

#include <fast_float/fast_float.h>

#include <cstdint>

#include "gcode/text/characters.hpp"

namespace twin::gcode {

namespace {

constexpr std::size_t kExactDigits = 15;  // whole numbers of so many digits are exact doubles
constexpr double kPowers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                              1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// The nearest double of digits with a point: a quotient of two exact doubles where there are few
/// digits, which is rounded once. @returns the characters read
std::size_t read_digits(std::string_view digits, double& magnitude) noexcept {
  std::uint64_t whole = 0;
  std::size_t at = 0;
  for (; at < digits.size() && is_digit(digits[at]); ++at) {
    whole = 10 * whole + static_cast<std::uint64_t>(digits[at] - '0');
  }
  std::size_t decimals = 0;
  if (at < digits.size() && digits[at] == '.') {
    for (++at; at < digits.size() && is_digit(digits[at]); ++at, ++decimals) {
      whole = 10 * whole + static_cast<std::uint64_t>(digits[at] - '0');
    }
  }
  if (at <= kExactDigits) {
    magnitude = static_cast<double>(whole) / kPowers[decimals];
    return at;
  }
  const auto result = fast_float::from_chars(digits.data(), digits.data() + digits.size(),
                                             magnitude, fast_float::chars_format::fixed);
  return static_cast<std::size_t>(result.ptr - digits.data());
}

}  // namespace

Number parse_number(std::string_view text) noexcept {
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  const std::string_view digits = text.substr(sign);
  const std::size_t point = !digits.empty() && digits[0] == '.' ? 1 : 0;
  if (digits.size() <= point || !is_digit(digits[point])) {
    return {};
  }
  double magnitude = 0.0;
  const std::size_t length = sign + read_digits(digits, magnitude);
  if (!(magnitude <= kLargestNumber)) {
    return {NumberStatus::kTooLarge, 0.0, length};
  }
  return {NumberStatus::kOk, text[0] == '-' ? -magnitude : magnitude, length};
}

}  // namespace twin::gcode
