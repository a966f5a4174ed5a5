#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string_view>

#include "gcode/words/codes.hpp"

namespace twin::gcode {
namespace {

/// Codes from first to last that are refused by name, and what may be written instead.
struct Refused {
  double first;
  double last;
  std::string_view name;
  std::string_view expected;
};

constexpr std::string_view kStraight =
    "expected G01 and arcs, or a NURBS by G05.2 to G05.3 or G06.2";
constexpr std::string_view kWriteOut = "expected its moves written out as G00 to G03";

constexpr Refused kRefusedG[] = {
    {6.0, 6.9, "spline", kStraight},
    {7.0, 7.0, "diameter programming", "expected a program for a mill"},
    {10.1, 10.9, "setting of data", "expected G10 with L1, L2, L10, L11 or L20"},
    {12.0, 13.9, "circular pocket or polar interpolation", kWriteOut},
    {17.1, 19.1, "plane of a rotary or parallel axis", "expected G17, G18 or G19"},
    {31.4, 31.9, "probing", "expected G31 or G38.2 to G38.5"},
    {32.0, 34.9, "thread cutting", "expected G33 with K, its lead"},
    {36.0, 37.9, "automatic measurement of a tool", "there is no sensor of tools"},
    {38.0, 38.9, "probing", "expected G38.2 to G38.5"},
    {43.3, 43.9, "control of the tool's centre point or axis", "there are no rotary axes"},
    {44.0, 44.9, "tool length compensation, minus", "expected G43 and a negative length"},
    {51.0, 51.0, "scaling", "controls do not agree on its factors; expected full size"},
    {53.1, 53.9, "machine kinematics", "there are no rotary axes"},
    {54.2, 54.9, "dynamic work offset", "there are no rotary axes"},
    {60.0, 60.0, "approach from one direction", "expected a G00 to the place"},
    {62.0, 63.0, "corner override or tapping mode", "expected G61 or G64"},
    {68.1, 68.9, "tilted plane", "there are no rotary axes"},
    {70.1, 72.9, "lathe cycle", "expected a program for a mill"},
    {76.1, 76.9, "threading cycle", kWriteOut},
    {75.0, 79.0, "canned cycle", kWriteOut},
    {87.0, 87.0, "back boring", "controls do not agree on its moves; expected them written out"},
    {88.0, 88.0, "boring with manual exit", "nobody moves the axes by hand; expected G85 or G89"},
    {100.0, 101.0, "mirror image of Haas", "expected G51.1 and G50.1"},
    {110.0, 129.9, "work offset or polar coordinates, as the control has it",
     "expected G54 to G59.3, G54.1 or G154 P"},
    {150.0, 150.9, "pocket", kWriteOut},
};

constexpr Refused kRefusedM[] = {
    {21.0, 22.0, "mirror image on some controls", "expected G51.1"},
    {25.0, 25.0, "move to home on some controls", "expected G28"},
    {47.0, 47.0, "the program again", "expected a loop"},
    {91.0, 92.0, "move to a switch, or machine coordinates, on some controls", "expected G53"},
    {96.0, 96.0, "interrupt by a macro", kWriteOut},
    {97.0, 97.0, "subprogram call", kWriteOut},
    {428.0, 430.0, "switch of kinematics", "there are no rotary axes"},
};

std::string refused(char letter, double number, std::span<const Refused> table,
                    std::string_view known) {
  for (const Refused& entry : table) {
    if (number >= entry.first - 1e-9 && number <= entry.last + 1e-9) {
      return fmt::format("{}{:.10g} ({}) is not supported: {}", letter, number, entry.name,
                         entry.expected);
    }
  }
  return fmt::format("{}{:.10g} is not known: expected {}", letter, number, known);
}

}  // namespace

std::string refused_g(double number) {
  return refused(
      'G', number, kRefusedG,
      "G00 to G05.3, G06.2, G06.3, G08 to G10, G15 to G21, G28, G30, G31, G33, G33.1, G38.2 to "
      "G43.2, G49 to G50.1, G51.1 to G59.3, G61, G61.1, G64, G68, G69, G73, G74, G76, G80 to G86, "
      "G89 to G99, G103, G154 or G187");
}

std::string refused_m(double number) {
  return refused('M', number, kRefusedM, "a whole number from M00 to M999");
}

std::string refused_letter(char letter) {
  switch (letter) {
    case 'A':
    case 'B':
    case 'C':
    case 'U':
    case 'V':
    case 'W':
      return fmt::format(
          "there is no axis {}: only X, Y and Z move; --ignore-axes {} leaves its "
          "words out",
          letter, static_cast<char>(letter - 'A' + 'a'));
    case 'O':
      return "O (program number or subprogram) is not supported: expected one program without it";
    default:
      return fmt::format(
          "the letter {} is not known: expected one of D E F G H I J K L M N P Q R S T X Y Z",
          letter);
  }
}

}  // namespace twin::gcode
