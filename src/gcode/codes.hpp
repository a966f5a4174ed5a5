#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace twin::gcode {

/// The G words this reader knows. Words of one modal group exclude each other on a line.
enum class GWord : std::uint8_t {
  kRapid,                 ///< G00
  kLinear,                ///< G01
  kArcClockwise,          ///< G02
  kArcCounterClockwise,   ///< G03
  kNurbs,                 ///< G05.2
  kNurbsEnd,              ///< G05.3
  kKnotNurbs,             ///< G06.2
  kKnotNurbsEnd,          ///< G06.3
  kCancelMotion,          ///< G80
  kDwell,                 ///< G04
  kPlaneXy,               ///< G17
  kPlaneZx,               ///< G18
  kPlaneYz,               ///< G19
  kInch,                  ///< G20
  kMillimetre,            ///< G21
  kAbsolute,              ///< G90
  kIncremental,           ///< G91
  kExactStop,             ///< G61, G61.1
  kContinuous,            ///< G64
  kNoCutterCompensation,  ///< G40
  kNoToolLength,          ///< G49
  kFirstWorkOffset,       ///< G54, whose offset is zero
  kFeedPerMinute,         ///< G94
};

enum class GGroup : std::uint8_t {
  kMotion,
  kDwell,
  kPlane,
  kUnits,
  kDistance,
  kPathMode,
  kCutterCompensation,
  kToolLength,
  kWorkOffset,
  kFeedMode,
};
inline constexpr std::size_t kGGroups = 10;

/// The M words this reader knows.
enum class MWord : std::uint8_t {
  kStop,          ///< M00: the path comes to rest
  kOptionalStop,  ///< M01: passes by, as with the switch of the panel off
  kEnd,           ///< M02, M30
  kToolChange,    ///< M06: the path comes to rest
  kSpindle,       ///< M03, M04, M05: no motion
  kCoolant,       ///< M07, M08, M09: no motion
};

enum class MGroup : std::uint8_t { kStop, kToolChange, kSpindle, kCoolant };
inline constexpr std::size_t kMGroups = 4;

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

/// What the number of a letter may be.
enum class LetterKind : std::uint8_t {
  kRefused,      ///< not a letter of this reader
  kCode,         ///< G and M: looked up by find_g() and find_m()
  kDecimal,      ///< X Y Z I J K R: any number
  kPositive,     ///< F: above zero
  kNotNegative,  ///< P, S: zero or more
  kCount,        ///< L, N, T: a whole number, zero or more
};

/// Kind of a letter from 'A' to 'Z'.
LetterKind kind_of(char letter) noexcept;

/// Why a letter is refused, and what was expected.
std::string refused_letter(char letter);

}  // namespace twin::gcode
