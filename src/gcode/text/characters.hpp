#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace twin::gcode {

inline bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
inline bool is_blank(char c) noexcept { return c == ' ' || c == '\t'; }
inline bool is_printable(char c) noexcept { return c >= 0x20 && c < 0x7F; }
inline bool is_control(char c) noexcept {
  return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == '\x7F';
}
inline char upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
inline bool is_letter(char c) noexcept { return upper(c) >= 'A' && upper(c) <= 'Z'; }

/// The character at a place, or 0 behind the text's end.
inline char at_or_zero(std::string_view text, std::size_t at) noexcept {
  return at < text.size() ? text[at] : '\0';
}

inline void skip_blanks(std::string_view text, std::size_t& at) noexcept {
  while (at < text.size() && is_blank(text[at])) {
    ++at;
  }
}

/// The printable characters before the next blank, eight at most.
std::string_view start_of(std::string_view text) noexcept;

/// Why a byte is refused outside comments: "byte 0x00 is not NC text ..."
std::string not_text(char c);

}  // namespace twin::gcode
