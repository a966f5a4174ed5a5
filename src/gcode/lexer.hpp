#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace twin::gcode {

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
