#include "gcode/codes.hpp"

#include <array>
#include <cmath>
#include <string_view>

namespace twin::gcode {
namespace {

constexpr std::size_t kGTenths = 950;  // numbers of G words in tenths, up to G94.9
constexpr std::size_t kMNumbers = 31;  // M0 to M30

using GTable = std::array<std::optional<GCode>, kGTenths>;
using MTable = std::array<std::optional<MCode>, kMNumbers>;

constexpr GTable make_g_table() {
  GTable table{};
  table[0] = GCode{GWord::kRapid, GGroup::kMotion};
  table[10] = GCode{GWord::kLinear, GGroup::kMotion};
  table[20] = GCode{GWord::kArcClockwise, GGroup::kMotion};
  table[30] = GCode{GWord::kArcCounterClockwise, GGroup::kMotion};
  table[52] = GCode{GWord::kNurbs, GGroup::kMotion};
  table[53] = GCode{GWord::kNurbsEnd, GGroup::kMotion};
  table[62] = GCode{GWord::kKnotNurbs, GGroup::kMotion};
  table[63] = GCode{GWord::kKnotNurbsEnd, GGroup::kMotion};
  table[800] = GCode{GWord::kCancelMotion, GGroup::kMotion};
  table[40] = GCode{GWord::kDwell, GGroup::kDwell};
  table[170] = GCode{GWord::kPlaneXy, GGroup::kPlane};
  table[180] = GCode{GWord::kPlaneZx, GGroup::kPlane};
  table[190] = GCode{GWord::kPlaneYz, GGroup::kPlane};
  table[200] = GCode{GWord::kInch, GGroup::kUnits};
  table[210] = GCode{GWord::kMillimetre, GGroup::kUnits};
  table[900] = GCode{GWord::kAbsolute, GGroup::kDistance};
  table[910] = GCode{GWord::kIncremental, GGroup::kDistance};
  table[610] = GCode{GWord::kExactStop, GGroup::kPathMode};
  table[611] = GCode{GWord::kExactStop, GGroup::kPathMode};
  table[640] = GCode{GWord::kContinuous, GGroup::kPathMode};
  table[400] = GCode{GWord::kNoCutterCompensation, GGroup::kCutterCompensation};
  table[490] = GCode{GWord::kNoToolLength, GGroup::kToolLength};
  table[540] = GCode{GWord::kFirstWorkOffset, GGroup::kWorkOffset};
  table[940] = GCode{GWord::kFeedPerMinute, GGroup::kFeedMode};
  return table;
}

constexpr MTable make_m_table() {
  MTable table{};
  table[0] = MCode{MWord::kStop, MGroup::kStop};
  table[1] = MCode{MWord::kOptionalStop, MGroup::kStop};
  table[2] = MCode{MWord::kEnd, MGroup::kStop};
  table[30] = MCode{MWord::kEnd, MGroup::kStop};
  for (const std::size_t number : {3U, 4U, 5U}) {
    table[number] = MCode{MWord::kSpindle, MGroup::kSpindle};
  }
  table[6] = MCode{MWord::kToolChange, MGroup::kToolChange};
  for (const std::size_t number : {7U, 8U, 9U}) {
    table[number] = MCode{MWord::kCoolant, MGroup::kCoolant};
  }
  return table;
}

constexpr GTable kGTable = make_g_table();
constexpr MTable kMTable = make_m_table();

/// The index of number times per_unit, or size if it is no whole number from 0 to size - 1.
///
/// 61.1 times 10 is not quite 611 in binary; a program's digits cannot mean anything between 611
/// and 611 + 1e-9.
std::size_t index_of(double number, double per_unit, std::size_t size) noexcept {
  const double scaled = number * per_unit;
  if (!(scaled >= 0.0) || scaled >= static_cast<double>(size) - 0.5) {
    return size;
  }
  const double rounded = std::round(scaled);
  return std::abs(scaled - rounded) < 1e-9 ? static_cast<std::size_t>(rounded) : size;
}

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

std::optional<GCode> find_g(double number) noexcept {
  const std::size_t index = index_of(number, 10.0, kGTable.size());
  return index < kGTable.size() ? kGTable[index] : std::nullopt;
}

std::optional<MCode> find_m(double number) noexcept {
  const std::size_t index = index_of(number, 1.0, kMTable.size());
  return index < kMTable.size() ? kMTable[index] : std::nullopt;
}

LetterKind kind_of(char letter) noexcept { return kKinds[static_cast<std::size_t>(letter - 'A')]; }

}  // namespace twin::gcode
