#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"

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

/// A fault of the program at a column of the line being read; Reader adds the file and the line.
///
/// @param column   column in the line, in bytes from 1, or 0
/// @param message  what was found and what was expected
inline tl::unexpected<Error> fail_at(int column, std::string message) {
  return tl::unexpected<Error>(Error{ErrorCode::kProgram, std::move(message), {}, 0, column});
}

/// One word of an NC line: a letter and its number.
struct Word {
  char letter = ' ';   ///< 'A' to 'Z', whatever the case in the program
  double value = 0.0;  ///< in the program's own units
  int column = 0;      ///< column of the letter, in bytes from 1
};

/// The words of one line, one at a time.
///
///   line = { blank | comment | word }
///   word = letter { blank } [ sign ] digits-with-point
/// A comment goes from ( to ) and has no comment inside, or from ; to the end of the line.
class Lexer {
 public:
  /// @param line  one line without its end; must outlive the lexer
  explicit Lexer(std::string_view line) : line_(line) {}

  /// Reads the next word.
  /// @returns the word, nothing at the end of the line, or an error with its column
  Expected<std::optional<Word>> next();

 private:
  Expected<void> skip_blanks_and_comments();
  Expected<void> skip_comment();
  tl::unexpected<Error> unexpected_character() const;
  tl::unexpected<Error> no_number(char letter, int column) const;
  char peek() const noexcept { return at_ < line_.size() ? line_[at_] : '\0'; }
  int column() const noexcept { return static_cast<int>(at_) + 1; }

  std::string_view line_;
  std::size_t at_ = 0;
};

}  // namespace twin::gcode
