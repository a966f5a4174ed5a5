#pragma once

#include <cstddef>
#include <string_view>

namespace twin::gcode {

/// Largest magnitude a number of an NC program may have, in the program's own units [-].
///
/// A coordinate of 1e9 mm still resolves 1e-7 mm; no sum or product of the reader can overflow
/// below it.
inline constexpr double kLargestNumber = 1e9;

enum class NumberStatus {
  kOk,
  kMissing,   ///< the text does not begin with a number
  kTooLarge,  ///< the number's magnitude is above kLargestNumber
};

/// A number read from the front of a text.
struct Number {
  NumberStatus status = NumberStatus::kMissing;
  double value = 0.0;      ///< the double nearest to the decimal number
  std::size_t length = 0;  ///< characters it takes up, sign included
};

/// Reads the decimal number at the front of a text: sign, digits and point, at least one digit.
///
/// NC numbers have no exponent; "nan" and "inf" are no numbers. Leading blanks are not skipped.
Number parse_number(std::string_view text) noexcept;

}  // namespace twin::gcode
