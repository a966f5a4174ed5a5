#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string_view>

#include "gcode/codes.hpp"

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
constexpr std::string_view kZeroOffset = "only G54 is, with offset zero";

constexpr Refused kRefusedG[] = {
    {5.0, 5.1, "spline", kStraight},
    {6.0, 6.9, "spline", kStraight},
    {7.0, 7.0, "diameter programming", "expected a program for a mill"},
    {8.0, 8.0, "radius programming", "expected a program for a mill"},
    {9.0, 9.0, "exact stop of one block", "expected G61"},
    {10.0, 10.9, "setting of offsets", kZeroOffset},
    {12.0, 13.9, "circular pocket or polar interpolation", kWriteOut},
    {15.0, 16.0, "polar coordinates", "expected X and Y"},
    {17.1, 19.1, "plane of a rotary or parallel axis", "expected G17, G18 or G19"},
    {28.0, 28.1, "return to home", "expected a G00 to the place"},
    {30.0, 30.1, "return to the second home", "expected a G00 to the place"},
    {31.0, 31.9, "probing", "there is no probe"},
    {32.0, 33.9, "thread cutting", "the spindle is not coupled to the axes"},
    {38.0, 38.9, "probing", "there is no probe"},
    {41.0, 41.1, "cutter compensation, left", "expected G40 and the path of the tool's centre"},
    {42.0, 42.1, "cutter compensation, right", "expected G40 and the path of the tool's centre"},
    {43.0, 44.9, "tool length compensation", "expected G49"},
    {50.0, 51.9, "scaling", "expected coordinates at full size"},
    {52.0, 52.0, "local offset", kZeroOffset},
    {53.0, 53.9, "machine coordinates", "expected the place in the coordinates of G54"},
    {54.1, 54.9, "extended work offset", kZeroOffset},
    {55.0, 59.9, "work offset", kZeroOffset},
    {60.0, 60.0, "approach from one direction", "expected a G00 to the place"},
    {62.0, 63.0, "corner override or tapping mode", "expected G61 or G64"},
    {65.0, 67.0, "macro call", kWriteOut},
    {68.0, 69.9, "rotation of coordinates", "expected coordinates already turned"},
    {70.0, 79.0, "canned cycle", kWriteOut},
    {81.0, 89.0, "canned cycle", kWriteOut},
    {90.1, 90.1, "absolute arc centres", "expected I J K from the start of the arc"},
    {91.1, 91.1, "incremental arc centres",
     "I J K are always from the start of the arc; leave it out"},
    {92.0, 92.9, "shift of coordinates", kZeroOffset},
    {93.0, 93.0, "inverse time feed", "expected G94, units per minute"},
    {95.0, 95.0, "feed per revolution", "expected G94, units per minute"},
    {96.0, 97.0, "spindle speed mode", "leave it out, the spindle does not move the table"},
    {98.0, 99.0, "return level of canned cycles", kWriteOut},
};

constexpr Refused kRefusedM[] = {
    {10.0, 11.0, "clamp", "leave it out"},
    {19.0, 19.0, "spindle orientation", "expected M03, M04 or M05"},
    {29.0, 29.0, "rigid tapping", "the spindle is not coupled to the axes"},
    {48.0, 53.0, "override control", "leave it out"},
    {60.0, 60.0, "pallet change", "expected M00"},
    {61.0, 61.0, "setting of the tool number", "expected T and M06"},
    {62.0, 68.0, "digital or analogue input and output", "leave it out"},
    {70.0, 73.0, "saving of the modal state", "leave it out"},
    {97.0, 97.0, "subprogram call", kWriteOut},
    {98.0, 98.0, "subprogram call", kWriteOut},
    {99.0, 99.0, "return from a subprogram", "expected M02 or M30 at the end of the program"},
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
  return refused('G', number, kRefusedG,
                 "G00 to G04, G05.2, G05.3, G06.2, G06.3, G17 to G21, G40, G49, G54, G61, G61.1, "
                 "G64, G80, G90, G91 or G94");
}

std::string refused_m(double number) {
  return refused('M', number, kRefusedM, "M00 to M09 or M30");
}

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
