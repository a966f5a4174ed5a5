#include "gcode/words/codes.hpp"

#include <array>
#include <cmath>
#include <string_view>

namespace twin::gcode {
namespace {

constexpr std::size_t kGTenths = 1880;   // numbers of G words in tenths, up to G187.9
constexpr std::size_t kMNumbers = 1000;  // M0 to M999

using GTable = std::array<std::optional<GCode>, kGTenths>;
using MTable = std::array<std::optional<MCode>, kMNumbers>;

/// A G word by its number in tenths.
struct GEntry {
  std::size_t tenths;
  GWord word;
  GGroup group;
};

constexpr GEntry kGEntries[] = {
    {0, GWord::kRapid, GGroup::kMotion},
    {10, GWord::kLinear, GGroup::kMotion},
    {20, GWord::kArcClockwise, GGroup::kMotion},
    {30, GWord::kArcCounterClockwise, GGroup::kMotion},
    {50, GWord::kCubicSpline, GGroup::kMotion},
    {51, GWord::kQuadraticSpline, GGroup::kMotion},
    {52, GWord::kNurbs, GGroup::kMotion},
    {53, GWord::kNurbsEnd, GGroup::kMotion},
    {62, GWord::kKnotNurbs, GGroup::kMotion},
    {63, GWord::kKnotNurbsEnd, GGroup::kMotion},
    {310, GWord::kSkip, GGroup::kMotion},
    {311, GWord::kSkip, GGroup::kMotion},
    {312, GWord::kSkip, GGroup::kMotion},
    {313, GWord::kSkip, GGroup::kMotion},
    {330, GWord::kThread, GGroup::kMotion},
    {331, GWord::kRigidTap, GGroup::kMotion},
    {382, GWord::kProbe, GGroup::kMotion},
    {383, GWord::kProbe, GGroup::kMotion},
    {384, GWord::kProbe, GGroup::kMotion},
    {385, GWord::kProbe, GGroup::kMotion},
    {760, GWord::kThreadCycle, GGroup::kMotion},
    {730, GWord::kChipBreak, GGroup::kMotion},
    {740, GWord::kTapLeft, GGroup::kMotion},
    {800, GWord::kCancelMotion, GGroup::kMotion},
    {810, GWord::kDrill, GGroup::kMotion},
    {820, GWord::kDrillDwell, GGroup::kMotion},
    {830, GWord::kPeckDrill, GGroup::kMotion},
    {840, GWord::kTapRight, GGroup::kMotion},
    {850, GWord::kBoreFeedOut, GGroup::kMotion},
    {860, GWord::kBoreRapidOut, GGroup::kMotion},
    {890, GWord::kBoreDwell, GGroup::kMotion},
    {40, GWord::kDwell, GGroup::kDwell},
    {90, GWord::kExactStopOnce, GGroup::kOnce},
    {100, GWord::kSetOffsets, GGroup::kSetting},
    {280, GWord::kHome, GGroup::kSetting},
    {281, GWord::kSetHome, GGroup::kSetting},
    {300, GWord::kSecondHome, GGroup::kSetting},
    {301, GWord::kSetSecondHome, GGroup::kSetting},
    {520, GWord::kLocalOffset, GGroup::kSetting},
    {920, GWord::kShift, GGroup::kSetting},
    {921, GWord::kClearShift, GGroup::kSetting},
    {922, GWord::kShiftOff, GGroup::kSetting},
    {923, GWord::kShiftOn, GGroup::kSetting},
    {530, GWord::kMachineCoordinates, GGroup::kMachineCoordinates},
    {170, GWord::kPlaneXy, GGroup::kPlane},
    {180, GWord::kPlaneZx, GGroup::kPlane},
    {190, GWord::kPlaneYz, GGroup::kPlane},
    {200, GWord::kInch, GGroup::kUnits},
    {210, GWord::kMillimetre, GGroup::kUnits},
    {700, GWord::kIsoInch, GGroup::kUnits},
    {710, GWord::kIsoMillimetre, GGroup::kUnits},
    {900, GWord::kAbsolute, GGroup::kDistance},
    {910, GWord::kIncremental, GGroup::kDistance},
    {901, GWord::kAbsoluteCentres, GGroup::kArcDistance},
    {911, GWord::kIncrementalCentres, GGroup::kArcDistance},
    {610, GWord::kExactStop, GGroup::kPathMode},
    {611, GWord::kExactStop, GGroup::kPathMode},
    {640, GWord::kContinuous, GGroup::kPathMode},
    {400, GWord::kNoCutterCompensation, GGroup::kCutterCompensation},
    {410, GWord::kCutterLeft, GGroup::kCutterCompensation},
    {411, GWord::kCutterLeftOf, GGroup::kCutterCompensation},
    {420, GWord::kCutterRight, GGroup::kCutterCompensation},
    {421, GWord::kCutterRightOf, GGroup::kCutterCompensation},
    {430, GWord::kToolLength, GGroup::kToolLength},
    {431, GWord::kToolOffset, GGroup::kToolLength},
    {432, GWord::kMoreToolOffset, GGroup::kToolLength},
    {490, GWord::kNoToolLength, GGroup::kToolLength},
    {540, GWord::kWorkOffset, GGroup::kWorkOffset},
    {541, GWord::kExtendedWorkOffset, GGroup::kWorkOffset},
    {1540, GWord::kExtendedWorkOffset, GGroup::kWorkOffset},
    {550, GWord::kWorkOffset, GGroup::kWorkOffset},
    {560, GWord::kWorkOffset, GGroup::kWorkOffset},
    {570, GWord::kWorkOffset, GGroup::kWorkOffset},
    {580, GWord::kWorkOffset, GGroup::kWorkOffset},
    {590, GWord::kWorkOffset, GGroup::kWorkOffset},
    {591, GWord::kWorkOffset, GGroup::kWorkOffset},
    {592, GWord::kWorkOffset, GGroup::kWorkOffset},
    {593, GWord::kWorkOffset, GGroup::kWorkOffset},
    {930, GWord::kInverseTime, GGroup::kFeedMode},
    {940, GWord::kFeedPerMinute, GGroup::kFeedMode},
    {950, GWord::kFeedPerRevolution, GGroup::kFeedMode},
    {960, GWord::kSurfaceSpeed, GGroup::kSpindleMode},
    {970, GWord::kSpindleSpeed, GGroup::kSpindleMode},
    {980, GWord::kReturnToInitial, GGroup::kReturnLevel},
    {990, GWord::kReturnToRetract, GGroup::kReturnLevel},
    {150, GWord::kNoPolar, GGroup::kPolar},
    {160, GWord::kPolar, GGroup::kPolar},
    {500, GWord::kNoScaling, GGroup::kScaling},
    {501, GWord::kNoMirror, GGroup::kMirror},
    {511, GWord::kMirror, GGroup::kMirror},
    {680, GWord::kRotation, GGroup::kRotation},
    {690, GWord::kNoRotation, GGroup::kRotation},
    {80, GWord::kRadiusMode, GGroup::kDiameter},
    {1870, GWord::kSmoothness, GGroup::kSmoothness},
    {1030, GWord::kLookAheadLimit, GGroup::kSmoothness},
    {650, GWord::kMacroCall, GGroup::kMacro},
    {660, GWord::kModalMacroCall, GGroup::kMacro},
    {670, GWord::kNoMacroCall, GGroup::kMacro},
};

constexpr GTable make_g_table() {
  GTable table{};
  for (const GEntry& entry : kGEntries) {
    table[entry.tenths] = GCode{entry.word, entry.group};
  }
  return table;
}

/// M words from first to last.
struct MEntry {
  std::size_t first;
  std::size_t last;
  MWord word;
  MGroup group;
};

constexpr MEntry kMEntries[] = {
    {0, 0, MWord::kStop, MGroup::kStop},
    {1, 1, MWord::kOptionalStop, MGroup::kStop},
    {2, 2, MWord::kEnd, MGroup::kStop},
    {30, 30, MWord::kEnd, MGroup::kStop},
    {60, 60, MWord::kStop, MGroup::kStop},
    {6, 6, MWord::kToolChange, MGroup::kToolChange},
    {61, 61, MWord::kToolNumber, MGroup::kToolChange},
    {3, 5, MWord::kSpindle, MGroup::kSpindle},
    {19, 19, MWord::kSpindle, MGroup::kSpindle},
    {29, 29, MWord::kSpindle, MGroup::kSpindle},
    {7, 9, MWord::kCoolant, MGroup::kCoolant},
    {48, 53, MWord::kOverride, MGroup::kOverride},
    {62, 68, MWord::kInputOutput, MGroup::kInputOutput},
    {10, 11, MWord::kClamp, MGroup::kClamp},
    {100, 199, MWord::kUserCommand, MGroup::kUserCommand},
};

/// M words that a control may take as a wish to move or to go elsewhere in the program: mirror
/// images, moves to home or to a switch, the program again, calls and interrupts, other kinematics.
constexpr std::size_t kMovesElsewhere[] = {21, 22, 25, 47, 91, 92, 96, 97, 428, 429, 430};

constexpr bool moves_elsewhere(std::size_t number) {
  for (const std::size_t known : kMovesElsewhere) {
    if (known == number) {
      return true;
    }
  }
  return false;
}

constexpr MTable make_m_table() {
  MTable table{};
  for (std::size_t number = 0; number < table.size(); ++number) {
    if (!moves_elsewhere(number)) {
      table[number] = MCode{MWord::kMachineFunction, MGroup::kMachineFunction};
    }
  }
  for (const MEntry& entry : kMEntries) {
    for (std::size_t number = entry.first; number <= entry.last; ++number) {
      table[number] = MCode{entry.word, entry.group};
    }
  }
  table[98] = MCode{MWord::kCallSubprogram, MGroup::kSubprogram};
  table[99] = MCode{MWord::kReturnFromSubprogram, MGroup::kSubprogram};
  table[70] = MCode{MWord::kSaveState, MGroup::kSavedState};
  table[71] = MCode{MWord::kForgetState, MGroup::kSavedState};
  table[72] = MCode{MWord::kRestoreState, MGroup::kSavedState};
  table[73] = MCode{MWord::kSaveStateForReturn, MGroup::kSavedState};
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

constexpr std::array<LetterKind, kLetters> make_kinds() {
  std::array<LetterKind, kLetters> kinds{};
  const auto set = [&kinds](std::string_view letters, LetterKind kind) {
    for (const char letter : letters) {
      kinds[static_cast<std::size_t>(letter - 'A')] = kind;
    }
  };
  set("GM", LetterKind::kCode);
  set("DEIJKPQRXYZ", LetterKind::kDecimal);
  set(kPolarLetters, LetterKind::kDecimal);
  set("F", LetterKind::kFeed);
  set("S", LetterKind::kNotNegative);
  set("HLNT", LetterKind::kCount);
  return kinds;
}

constexpr std::array<LetterKind, kLetters> kKinds = make_kinds();

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
