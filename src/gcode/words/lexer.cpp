#include "gcode/words/lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "gcode/text/fault.hpp"
#include "gcode/values/expression.hpp"
#include "gcode/values/number.hpp"
#include "gcode/values/parameters.hpp"
#include "gcode/words/codes.hpp"

namespace twin::gcode {
namespace {

std::string too_large(char letter) {
  return fmt::format("the number of {} is too large: expected at most {:.0f}", shown(letter),
                     kLargestNumber);
}

tl::unexpected<Error> exponent(char letter, int column) {
  return fail_at(column, fmt::format("{} has a number with an exponent: expected a plain decimal "
                                     "number such as {}0.001",
                                     shown(letter), shown(letter)));
}

/// True if a value that is computed begins a text: # or [, with a sign or not, or two letters and a
/// [ behind them, as a function has them.
bool begins_computed_value(std::string_view text) noexcept {
  std::size_t at = 0;
  while (at < text.size() && (is_blank(text[at]) || text[at] == '+' || text[at] == '-')) {
    ++at;
  }
  const char c = at_or_zero(text, at);
  return begins_value(c) || (is_letter(c) && is_letter(at_or_zero(text, at + 1)) &&
                             text.find('[', at) != std::string_view::npos);
}

}  // namespace

Lexer::Found Lexer::next(Word& word) {
  if (!skip_what_is_no_word()) {
    return Found::kFault;
  }
  if (at_ == line_.size()) {
    return Found::kEnd;
  }
  word.letter = upper(line_[at_]);
  word.column = column();
  if (word.letter < 'A' || word.letter > 'Z') {
    if (word.letter == '$' && at_ > 0) {
      return step_over_spindle(word);
    }
    if (word.letter != '@' && word.letter != '^') {
      return fault(unexpected_character().value());
    }
    word.letter = word.letter == '@' ? kPolarRadius : kPolarAngle;
  }
  ++at_;
  skip_blanks(line_, at_);
  const Number number = parse_number(line_.substr(at_));
  if (number.status != NumberStatus::kOk || word.letter == 'N') {
    return read_unusual_number(number, word);
  }
  word.value = number.value;
  word.has_point =
      word.letter == 'P' && line_.substr(at_, number.length).find('.') != std::string_view::npos;
  at_ += number.length;
  return upper(peek()) == 'E' ? fault(exponent(word.letter, column()).value()) : Found::kWord;
}

Lexer::Found Lexer::fault(Error error) {
  fault_ = std::move(error);
  return Found::kFault;
}

/// $ and the number of a spindle, which LinuxCNC's M03 to M05 may have.
Lexer::Found Lexer::step_over_spindle(Word& word) {
  ++at_;
  auto number = read_value(line_, at_, parameters_);
  return number ? next(word) : fault(std::move(number).error());
}

void Lexer::skip_fault() noexcept {
  fault_.reset();
  if (at_ < line_.size() && !is_blank(line_[at_])) {
    at_ = std::min(line_.find_first_of(" \t", at_), line_.size());
  } else if (at_ < line_.size()) {
    ++at_;
  }
}

/// A line number, a number with blanks behind its sign, a value that is computed, or none.
Lexer::Found Lexer::read_unusual_number(const Number& number, Word& word) {
  if (number.status == NumberStatus::kMissing && begins_computed_value(line_.substr(at_))) {
    return compute(word);
  }
  Number found = number;
  std::size_t begin = at_;
  if (number.status == NumberStatus::kMissing && (peek() == '-' || peek() == '+')) {
    std::size_t digits = at_ + 1;
    skip_blanks(line_, digits);
    if (digits > at_ + 1 && at_or_zero(line_, digits) != '-' && at_or_zero(line_, digits) != '+') {
      found = parse_number(line_.substr(digits));
      found.value = peek() == '-' ? -found.value : found.value;
      begin = digits;
    }
  }
  if (found.status == NumberStatus::kMissing) {
    return fault(no_number(word.letter, word.column).value());
  }
  if (found.status == NumberStatus::kTooLarge && word.letter != 'N') {
    return fault(fail_at(word.column, too_large(word.letter)).value());
  }
  word.value = word.letter == 'N' ? std::floor(found.value) : found.value;
  word.has_point = false;
  at_ = begin + found.length;
  return upper(peek()) == 'E' ? fault(exponent(word.letter, column()).value()) : Found::kWord;
}

Lexer::Found Lexer::compute(Word& word) {
  // Neither moves anything, so what only the machine knows may be 0 there.
  parameters_.allow_unknown(word.letter == 'F' || word.letter == 'S');
  auto value = read_value_or_null(line_, at_, parameters_);
  parameters_.allow_unknown(false);
  if (!value) {
    return fault(std::move(value).error());
  }
  if (is_null(*value)) {
    return next(word);
  }
  if (!(std::abs(*value) <= kLargestNumber)) {
    return fault(fail_at(word.column, too_large(word.letter)).value());
  }
  word.value = *value;
  word.has_point = false;
  return Found::kWord;
}

/// Steps over blanks, comments and assignments. @returns false at a fault
bool Lexer::skip_what_is_no_word() {
  while (at_ < line_.size()) {
    const char c = line_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (c == '(' || c == ';') {
      auto comment = read_comment(line_, at_);
      if (!comment) {
        fault(std::move(comment).error());
        return false;
      }
      comment_ = comment->text;
      oddity_ = comment->oddity == CommentOddity::kNone ? oddity_ : comment->oddity;
      at_ = comment->end;
    } else if (c == '#') {
      if (auto done = read_assignment(line_, at_, parameters_); !done) {
        fault(std::move(done).error());
        return false;
      }
    } else {
      break;
    }
  }
  return true;
}

tl::unexpected<Error> Lexer::unexpected_character() const {
  const char c = line_[at_];
  if (!is_printable(c)) {
    return fail_at(column(), not_text(c));
  }
  if (c == '%') {
    return fail_at(column(), "'%' must be the first character of its line");
  }
  if (c == '/') {
    return fail_at(column(), "'/' (block delete) must be the first character of its line");
  }
  if (const char next = upper(at_or_zero(line_, at_ + 1));
      c == ',' && (next == 'R' || next == 'C')) {
    return fail_at(column(), fmt::format("',{}' (a corner rounded or broken) is not supported: "
                                         "expected its moves written out as G00 to G03",
                                         next));
  }
  return fail_at(column(), fmt::format("unexpected '{}': expected a letter and a number", c));
}

tl::unexpected<Error> Lexer::no_number(char letter, int column_of_letter) const {
  if (at_ == line_.size()) {
    return fail_at(
        column_of_letter,
        fmt::format("{} has no number: expected one before the end of the line", shown(letter)));
  }
  const char c = line_[at_];
  if (!is_printable(c)) {
    return fail_at(column(), not_text(c));
  }
  return fail_at(column_of_letter, fmt::format("{} has no number: expected one, found '{}'",
                                               shown(letter), start_of(line_.substr(at_))));
}

}  // namespace twin::gcode
