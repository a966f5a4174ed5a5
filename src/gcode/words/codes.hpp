#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace twin::gcode {

/// The G words this reader knows. Words of one modal group exclude each other on a line; only G80
/// gives way to another word of motion.
enum class GWord : std::uint8_t {
  kRapid,                 ///< G00
  kLinear,                ///< G01
  kArcClockwise,          ///< G02
  kArcCounterClockwise,   ///< G03
  kCubicSpline,           ///< G05
  kQuadraticSpline,       ///< G05.1
  kNurbs,                 ///< G05.2
  kNurbsEnd,              ///< G05.3
  kKnotNurbs,             ///< G06.2
  kKnotNurbsEnd,          ///< G06.3
  kProbe,                 ///< G38.2 to G38.5
  kSkip,                  ///< G31, G31.1 to G31.3 of FANUC and Mach: a probing move, not modal
  kThread,                ///< G33
  kRigidTap,              ///< G33.1
  kThreadCycle,           ///< G76, LinuxCNC's
  kCancelMotion,          ///< G80
  kChipBreak,             ///< G73
  kTapLeft,               ///< G74
  kDrill,                 ///< G81
  kDrillDwell,            ///< G82
  kPeckDrill,             ///< G83
  kTapRight,              ///< G84
  kBoreFeedOut,           ///< G85
  kBoreRapidOut,          ///< G86
  kBoreDwell,             ///< G89
  kDwell,                 ///< G04
  kExactStopOnce,         ///< G09
  kSetOffsets,            ///< G10
  kHome,                  ///< G28
  kSetHome,               ///< G28.1
  kSecondHome,            ///< G30
  kSetSecondHome,         ///< G30.1
  kLocalOffset,           ///< G52
  kShift,                 ///< G92
  kClearShift,            ///< G92.1
  kShiftOff,              ///< G92.2
  kShiftOn,               ///< G92.3
  kMachineCoordinates,    ///< G53
  kPlaneXy,               ///< G17
  kPlaneZx,               ///< G18
  kPlaneYz,               ///< G19
  kInch,                  ///< G20
  kMillimetre,            ///< G21
  kIsoInch,               ///< G70 of Mach and ISO 6983; a lathe's cycle has further words
  kIsoMillimetre,         ///< G71
  kAbsolute,              ///< G90
  kIncremental,           ///< G91
  kAbsoluteCentres,       ///< G90.1
  kIncrementalCentres,    ///< G91.1
  kExactStop,             ///< G61, G61.1
  kContinuous,            ///< G64
  kNoCutterCompensation,  ///< G40
  kCutterLeft,            ///< G41
  kCutterLeftOf,          ///< G41.1
  kCutterRight,           ///< G42
  kCutterRightOf,         ///< G42.1
  kToolLength,            ///< G43
  kToolOffset,            ///< G43.1
  kMoreToolOffset,        ///< G43.2
  kNoToolLength,          ///< G49
  kWorkOffset,            ///< G54 to G59.3, by their number
  kExtendedWorkOffset,    ///< G54.1, G154 of Haas
  kInverseTime,           ///< G93
  kFeedPerMinute,         ///< G94
  kFeedPerRevolution,     ///< G95
  kSurfaceSpeed,          ///< G96
  kSpindleSpeed,          ///< G97
  kReturnToInitial,       ///< G98
  kReturnToRetract,       ///< G99
  kNoPolar,               ///< G15
  kPolar,                 ///< G16
  kNoScaling,             ///< G50
  kNoMirror,              ///< G50.1
  kMirror,                ///< G51.1
  kRotation,              ///< G68
  kNoRotation,            ///< G69
  kRadiusMode,            ///< G08 of lathes: X is a radius, as it is anyway
  kSmoothness,            ///< G187: a wish about smoothness that changes no move
  kLookAheadLimit,        ///< G103 of Haas: blocks that are read ahead
  kMacroCall,             ///< G65, FANUC: a subprogram with arguments
  kModalMacroCall,        ///< G66: the same behind every move
  kNoMacroCall,           ///< G67
};

enum class GGroup : std::uint8_t {
  kMotion,
  kDwell,
  kOnce,
  kSetting,
  kMachineCoordinates,
  kPlane,
  kUnits,
  kDistance,
  kArcDistance,
  kPathMode,
  kCutterCompensation,
  kToolLength,
  kWorkOffset,
  kFeedMode,
  kSpindleMode,
  kReturnLevel,
  kPolar,
  kScaling,
  kMirror,
  kRotation,
  kSmoothness,
  kDiameter,
  kMacro,
};
inline constexpr std::size_t kGGroups = 23;

/// The M words this reader knows.
enum class MWord : std::uint8_t {
  kStop,                  ///< M00, M60: the path comes to rest
  kOptionalStop,          ///< M01: passes by, as with the switch of the panel off
  kEnd,                   ///< M02, M30
  kToolChange,            ///< M06: the path comes to rest
  kToolNumber,            ///< M61: another tool is in the spindle from here on
  kSpindle,               ///< M03, M04, M05, M19, M29: no motion
  kCoolant,               ///< M07, M08, M09: no motion
  kOverride,              ///< M48 to M53: no motion
  kInputOutput,           ///< M62 to M68: no motion
  kClamp,                 ///< M10, M11: no motion
  kMachineFunction,       ///< of the machine's builder, as M41 or M88: no motion
  kUserCommand,           ///< M100 to M199: a program of the user, which is not run
  kCallSubprogram,        ///< M98
  kReturnFromSubprogram,  ///< M99
  kSaveState,             ///< M70
  kForgetState,           ///< M71
  kRestoreState,          ///< M72
  kSaveStateForReturn,    ///< M73: restored where the subroutine ends
};

enum class MGroup : std::uint8_t {
  kStop,
  kToolChange,
  kSpindle,
  kCoolant,
  kOverride,
  kInputOutput,
  kClamp,
  kMachineFunction,
  kUserCommand,
  kSubprogram,
  kSavedState,
};
inline constexpr std::size_t kMGroups = 11;

/// Whether several words of a group may be on a line.
constexpr bool may_repeat(MGroup group) noexcept {
  return group >= MGroup::kCoolant && group <= MGroup::kUserCommand;
}

struct GCode {
  GWord word;
  GGroup group;
};

struct MCode {
  MWord word;
  MGroup group;
};

/// The G word of a number such as 1 or 61.1, or nullopt.
std::optional<GCode> find_g(double number) noexcept;

/// The M word of a number such as 30, or nullopt.
std::optional<MCode> find_m(double number) noexcept;

/// Why a G word is refused, by name if it has one: "G41 (cutter compensation) is not supported:
/// ..."
std::string refused_g(double number);

/// Why an M word is refused, by name if it has one.
std::string refused_m(double number);

/// Letters of LinuxCNC's polar words @ (distance from the origin) and ^ (angle in degrees): the two
/// characters behind Z, so that they have places in tables of letters.
inline constexpr char kPolarRadius = 'Z' + 1;
inline constexpr char kPolarAngle = 'Z' + 2;
inline constexpr std::string_view kPolarLetters = "[\\";
inline constexpr std::size_t kLetters = 28;

/// A letter as a program has it: @ and ^ for the polar ones.
constexpr char shown(char letter) noexcept {
  return letter == kPolarRadius ? '@' : letter == kPolarAngle ? '^' : letter;
}

/// What the number of a letter may be.
enum class LetterKind : std::uint8_t {
  kRefused,      ///< not a letter of this reader
  kCode,         ///< G and M: looked up by find_g() and find_m()
  kDecimal,      ///< D E I J K P Q R X Y Z @ ^: any number
  kFeed,         ///< F: zero or more, and above zero for a feed move
  kNotNegative,  ///< S: zero or more
  kCount,        ///< H, L, N, T: a whole number, zero or more
};

/// Kind of a letter from 'A' to kPolarAngle.
LetterKind kind_of(char letter) noexcept;

/// Why a letter is refused, and what was expected.
std::string refused_letter(char letter);

}  // namespace twin::gcode
