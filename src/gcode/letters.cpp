#include "gcode/letters.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace twin::gcode {
namespace {

constexpr std::array<LetterKind, 26> make_kinds() {
  std::array<LetterKind, 26> kinds{};
  const auto set = [&kinds](std::string_view letters, LetterKind kind) {
    for (const char letter : letters) {
      kinds[static_cast<std::size_t>(letter - 'A')] = kind;
    }
  };
  set("GM", LetterKind::kCode);
  set("XYZIJKR", LetterKind::kDecimal);
  set("F", LetterKind::kPositive);
  set("PS", LetterKind::kNotNegative);
  set("LNT", LetterKind::kCount);
  return kinds;
}

constexpr std::array<LetterKind, 26> kKinds = make_kinds();

}  // namespace

LetterKind kind_of(char letter) noexcept { return kKinds[static_cast<std::size_t>(letter - 'A')]; }

std::string refused_letter(char letter) {
  switch (letter) {
    case 'A':
    case 'B':
    case 'C':
    case 'U':
    case 'V':
    case 'W':
      return fmt::format("there is no axis {}: only X, Y and Z move", letter);
    case 'D':
    case 'H':
      return fmt::format("{} (offset number) is not supported: offsets are zero", letter);
    case 'O':
      return "O (program number or subprogram) is not supported: expected one program without it";
    case 'Q':
      return "Q (second parameter of G64 or a canned cycle) is not supported";
    default:
      return fmt::format(
          "the letter {} is not known: expected one of F G I J K L M N P R S T X Y Z", letter);
  }
}

}  // namespace twin::gcode
