#pragma once

#include <cstdint>
#include <string>

namespace twin::gcode {

/// What the number of a letter may be.
enum class LetterKind : std::uint8_t {
  kRefused,      ///< not a letter of this reader
  kCode,         ///< G and M: looked up in codes.hpp
  kDecimal,      ///< X Y Z I J K R: any number
  kPositive,     ///< F: above zero
  kNotNegative,  ///< P, S: zero or more
  kCount,        ///< L, N, T: a whole number, zero or more
};

/// Kind of a letter from 'A' to 'Z'.
LetterKind kind_of(char letter) noexcept;

/// Why a letter is refused, and what was expected.
std::string refused_letter(char letter);

}  // namespace twin::gcode
