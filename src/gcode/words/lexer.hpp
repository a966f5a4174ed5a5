#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "gcode/text/characters.hpp"
#include "gcode/text/comment.hpp"

namespace twin::gcode {

class Parameters;
struct Number;

/// One word of an NC line: a letter and its number.
struct Word {
  char letter = ' ';       ///< 'A' to kPolarAngle, whatever the case in the program
  double value = 0.0;      ///< in the program's own units
  int column = 0;          ///< column of the letter, in bytes from 1
  bool has_point = false;  ///< the number is written with a decimal point
};

/// The words of one line, one at a time.
///
///   line       = { blank | comment | word | assignment }
///   word       = ( letter | @ | ^ | $ ) { blank } ( [ sign ] digits-with-point | value )
///   assignment = # value = value
/// A comment goes from ( to ), or from ; to the end of the line (read_comment()). Values that are
/// not plain numbers are computed (read_value()); a word whose value is null is left out,
/// and so is $, the number of a spindle.
/// Assignments are kept in the parameters for Parameters::commit().
class Lexer {
 public:
  /// @param line        one line without its end; must outlive the lexer
  /// @param parameters  must outlive the lexer
  Lexer(std::string_view line, Parameters& parameters) : line_(line), parameters_(parameters) {}

  /// What next() has found.
  enum class Found : std::uint8_t { kWord, kEnd, kFault };

  /// Reads the next word. A plain status instead of an Expected: this is the innermost loop.
  Found next(Word& word);

  /// Steps over the word in which next() has found a fault.
  void skip_fault() noexcept;

  /// Why next() gave kFault, with its column.
  Error take_fault() { return fault_ ? *std::move(fault_) : Error{}; }

  /// The last comment of the line up to here, without its parentheses.
  std::string_view comment() const noexcept { return comment_; }
  /// The last unusual thing about the comments up to here.
  CommentOddity oddity() const noexcept { return oddity_; }

 private:
  bool skip_what_is_no_word();
  Found read_unusual_number(const Number& number, Word& word);
  Found compute(Word& word);
  Found step_over_spindle(Word& word);
  Found fault(Error error);
  tl::unexpected<Error> unexpected_character() const;
  tl::unexpected<Error> no_number(char letter, int column) const;
  char peek() const noexcept { return at_or_zero(line_, at_); }
  int column() const noexcept { return static_cast<int>(at_) + 1; }

  std::string_view line_;
  Parameters& parameters_;
  std::size_t at_ = 0;
  std::string_view comment_;
  CommentOddity oddity_ = CommentOddity::kNone;
  std::optional<Error> fault_;
};

}  // namespace twin::gcode
