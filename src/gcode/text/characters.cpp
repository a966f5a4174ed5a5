#include "gcode/text/characters.hpp"

#include <fmt/format.h>

namespace twin::gcode {

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

}  // namespace twin::gcode
