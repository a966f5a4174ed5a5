#include "gcode/number.hpp"

#include <fast_float/fast_float.h>
#include <cmath>

namespace twin::gcode {
namespace {

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

}  // namespace

Number parse_number(std::string_view text) noexcept {
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  const std::string_view digits = text.substr(sign);
  const std::size_t point = !digits.empty() && digits[0] == '.' ? 1 : 0;
  if (digits.size() <= point || !is_digit(digits[point])) {
    return {};
  }
  double magnitude = 0.0;
  const auto result = fast_float::from_chars(digits.data(), digits.data() + digits.size(),
                                             magnitude, fast_float::chars_format::fixed);
  const auto length = static_cast<std::size_t>(result.ptr - text.data());
  if (!(magnitude <= kLargestNumber)) {
    return {NumberStatus::kTooLarge, 0.0, length};
  }
  return {NumberStatus::kOk, text[0] == '-' ? -magnitude : magnitude, length};
}

}  // namespace twin::gcode
