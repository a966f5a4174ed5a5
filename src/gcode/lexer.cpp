#include "gcode/lexer.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

namespace twin::gcode {
namespace {

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

bool is_blank(char c) noexcept { return c == ' ' || c == '\t'; }
bool is_control(char c) noexcept {
  return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == '\x7F';
}
bool is_printable(char c) noexcept { return c >= 0x20 && c < 0x7F; }
bool is_of_expression(char c) noexcept { return c == '#' || c == '[' || c == ']' || c == '='; }
char upper(char c) noexcept { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// The printable characters before the next blank, eight at most.
std::string_view start_of(std::string_view text) noexcept {
  std::size_t length = 0;
  while (length < text.size() && length < 8 && is_printable(text[length]) && text[length] != ' ') {
    ++length;
  }
  return text.substr(0, length);
}

std::string not_text(char c) {
  return fmt::format("byte 0x{:02X} is not NC text: is this an NC program?",
                     static_cast<unsigned char>(c));
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
  const auto result = fast_float::from_chars(digits.data(), digits.data() + digits.size(),
                                             magnitude, fast_float::chars_format::fixed);
  const auto length = static_cast<std::size_t>(result.ptr - text.data());
  if (!(magnitude <= kLargestNumber)) {
    return {NumberStatus::kTooLarge, 0.0, length};
  }
  return {NumberStatus::kOk, text[0] == '-' ? -magnitude : magnitude, length};
}

Expected<std::optional<Word>> Lexer::next() {
  TWIN_CHECK(skip_blanks_and_comments());
  if (at_ == line_.size()) {
    return std::nullopt;
  }
  Word word;
  word.letter = upper(line_[at_]);
  word.column = column();
  if (word.letter < 'A' || word.letter > 'Z') {
    return unexpected_character();
  }
  ++at_;
  while (is_blank(peek())) {
    ++at_;
  }
  const Number number = parse_number(line_.substr(at_));
  if (number.status == NumberStatus::kMissing) {
    return no_number(word.letter, word.column);
  }
  if (number.status == NumberStatus::kTooLarge) {
    return fail_at(word.column,
                   fmt::format("the number of {} is too large: expected at most {:.0f}",
                               word.letter, kLargestNumber));
  }
  word.value = number.value;
  at_ += number.length;
  if (upper(peek()) == 'E') {
    return fail_at(column(),
                   fmt::format("{} has a number with an exponent: expected a plain decimal "
                               "number such as {}0.001",
                               word.letter, word.letter));
  }
  return word;
}

Expected<void> Lexer::skip_blanks_and_comments() {
  while (at_ < line_.size()) {
    const char c = line_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (c == '(' || c == ';') {
      TWIN_CHECK(skip_comment());
    } else {
      break;
    }
  }
  return {};
}

Expected<void> Lexer::skip_comment() {
  const int opened = column();
  const bool is_bracketed = line_[at_] == '(';
  for (++at_; at_ < line_.size(); ++at_) {
    const char c = line_[at_];
    if (is_control(c)) {
      return fail_at(column(), not_text(c));
    }
    if (is_bracketed && c == '(') {
      return fail_at(column(), "a comment within a comment: expected ) first");
    }
    if (is_bracketed && c == ')') {
      ++at_;
      return {};
    }
  }
  if (is_bracketed) {
    return fail_at(opened, "the comment has no end: expected ) on the same line");
  }
  return {};
}

tl::unexpected<Error> Lexer::unexpected_character() const {
  const char c = line_[at_];
  if (!is_printable(c)) {
    return fail_at(column(), not_text(c));
  }
  if (is_of_expression(c)) {
    return fail_at(column(), fmt::format("'{}': variables and expressions are not supported; "
                                         "expected a letter and a number",
                                         c));
  }
  if (c == '%') {
    return fail_at(column(), "'%' must be the first character of its line");
  }
  if (c == '/') {
    return fail_at(column(), "'/' (block delete) must be the first character of its line");
  }
  return fail_at(column(), fmt::format("unexpected '{}': expected a letter and a number", c));
}

tl::unexpected<Error> Lexer::no_number(char letter, int column_of_letter) const {
  if (at_ == line_.size()) {
    return fail_at(
        column_of_letter,
        fmt::format("{} has no number: expected one before the end of the line", letter));
  }
  const char c = line_[at_];
  if (!is_printable(c)) {
    return fail_at(column(), not_text(c));
  }
  if (is_of_expression(c)) {
    return fail_at(column(), fmt::format("{} followed by '{}': variables and expressions are not "
                                         "supported; expected a number",
                                         letter, c));
  }
  return fail_at(column_of_letter, fmt::format("{} has no number: expected one, found '{}'", letter,
                                               start_of(line_.substr(at_))));
}

}  // namespace twin::gcode
