#include "gcode/interpreter/line_check.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "gcode/interpreter/line_letters.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "gcode/notes.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

/// Least path tolerance, in the program's unit: places of the path are known to a thousandth of it.
constexpr double kFinestTolerance = 1e-6;

constexpr std::string_view kAxisWords = "XYZ";
constexpr std::string_view kCentre = "IJK";
constexpr std::string_view kOfArcs = "IJKR";
constexpr std::uint32_t kPlain = LineWords::set_of("FNSTXYZ") | LineWords::set_of(kPolarLetters);

std::string_view name_of(const ModalState& state) {
  switch (state.motion) {
    case MotionMode::kLinear:
      return "G01";
    case MotionMode::kArcClockwise:
      return "G02";
    case MotionMode::kArcCounterClockwise:
      return "G03";
    case MotionMode::kCycle:
      return "the canned cycle";
    case MotionMode::kProbe:
    case MotionMode::kSkip:
      return "the probing move";
    default:
      return "G00";
  }
}

/// The plane's G word, its offset letters, and the letter that does not belong to it.
struct PlaneWords {
  std::string_view code;
  std::string_view offsets;
  char foreign;
};

PlaneWords words_of(Plane plane) {
  switch (plane) {
    case Plane::kZx:
      return {"G18", "I and K", 'J'};
    case Plane::kYz:
      return {"G19", "J and K", 'I'};
    default:
      return {"G17", "I and J", 'K'};
  }
}

std::string nothing_uses(char letter) {
  switch (letter) {
    case 'I':
    case 'J':
    case 'K':
    case 'R':
      return "an arc's I, J, K or R needs G02 or G03 in force";
    case 'L':
      return "L (repeat count, or order of a NURBS) needs G05.2 on its line";
    case 'P':
      return "P needs G04 or G64 on its line";
    case 'E':
      return "E (a 3D printer's extruder) moves nothing here: --ignore-axes e leaves its words out";
    default:
      return fmt::format("{} belongs to no word of its line", letter);
  }
}

/// Looks for letters that nothing on the line uses.
Expected<void> check_letters(const LineWords& words, const ModalState& state, Notes& notes,
                             std::int64_t line) {
  const std::uint32_t left = words.letters() & ~kPlain & ~letters_taken(words, state);
  if (left == 0) {
    return {};
  }
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if ((left & LineWords::set_of(std::string_view(&letter, 1))) == 0) {
      continue;
    }
    const bool is_zero_centre =
        kCentre.find(letter) != std::string_view::npos && words.value(letter) == 0.0;
    if (letter != 'D' && letter != 'H' && !is_zero_centre) {
      return fail_at(words.column(letter), nothing_uses(letter));
    }
    notes.add(NoteKind::kWithoutEffect,
              fmt::format("{} without a word that uses it has no effect", letter), line);
  }
  return {};
}

Expected<void> check_p_and_dwell(const LineWords& words) {
  const bool is_dwell = words.has(GGroup::kDwell);
  const bool is_continuous = words.has(GGroup::kPathMode, GWord::kContinuous);
  if (words.has('P') && is_dwell && is_continuous) {
    return fail_at(words.column('P'),
                   "P with both G04 and G64: expected them on lines of their own");
  }
  if (words.has('P') && (is_dwell || is_continuous) && words.value('P') < 0.0) {
    return fail_at(words.column('P'),
                   fmt::format("P{:.10g}: expected zero or more", words.value('P')));
  }
  if (words.has('P') && is_continuous && words.value('P') > 0.0 &&
      words.value('P') < kFinestTolerance) {
    return fail_at(words.column('P'),
                   fmt::format("P{:.10g}: a path tolerance finer than coordinates can tell: "
                               "expected 0, or at least {:.10g}",
                               words.value('P'), kFinestTolerance));
  }
  if (is_dwell && !words.has('P')) {
    return fail_at(words.column(GGroup::kDwell), "G04 has no time: expected P, in seconds");
  }
  if (is_dwell && words.has_any("XYZIJKR") &&
      (!words.has(GGroup::kMotion) || words.has(GGroup::kMotion, GWord::kCancelMotion))) {
    return fail_at(words.first_column("XYZIJKR"),
                   "a move beside G04: expected P, in seconds, and no other word");
  }
  return {};
}

Expected<void> check_arc_words(const LineWords& words, const ModalState& state) {
  const PlaneWords plane = words_of(state.plane);
  if (!words.has_any(kOfArcs)) {
    if (words.has_any(kAxisWords)) {
      return fail_at(
          words.first_column(kAxisWords),
          fmt::format("{} has no centre: expected {}, or R", name_of(state), plane.offsets));
    }
    return {};
  }
  if (words.has('R') && words.has_any(kCentre)) {
    return fail_at(words.column('R'),
                   fmt::format("R beside I, J or K: expected {}, or R, not both", plane.offsets));
  }
  if (words.has(plane.foreign) && words.value(plane.foreign) != 0.0) {
    return fail_at(words.column(plane.foreign),
                   fmt::format("{} does not belong to the plane of {}: expected {}", plane.foreign,
                               plane.code, plane.offsets));
  }
  if (state.has_absolute_centres && words.has_any(kCentre)) {
    for (const char letter : kCentre) {
      if (letter != plane.foreign && !words.has(letter)) {
        return fail_at(words.first_column(kCentre),
                       fmt::format("{} is missing: expected {}, for G90.1 (absolute centres) is in "
                                   "force",
                                   letter, plane.offsets));
      }
    }
  }
  return {};
}

/// Whether the word of a line that sets something, or goes home, does it by X Y Z.
bool uses_axes(const LineWords& words) {
  if (!words.has(GGroup::kSetting)) {
    return false;
  }
  switch (words.g(GGroup::kSetting)) {
    case GWord::kClearShift:
    case GWord::kShiftOff:
    case GWord::kShiftOn:
      return false;
    default:
      return true;
  }
}

/// At most one word of a line may use its X Y Z.
Expected<void> check_axis_users(const LineWords& words) {
  const bool by_setting = uses_axes(words);
  const int users = static_cast<int>(by_setting) +
                    static_cast<int>(words.has(GGroup::kMachineCoordinates)) +
                    static_cast<int>(words.has(GGroup::kToolLength, GWord::kToolOffset)) +
                    static_cast<int>(words.has(GGroup::kToolLength, GWord::kMoreToolOffset)) +
                    static_cast<int>(words.has(GGroup::kMirror)) +
                    static_cast<int>(words.has(GGroup::kRotation, GWord::kRotation));
  const bool goes_straight_home =
      (words.has(GGroup::kSetting, GWord::kHome) ||
       words.has(GGroup::kSetting, GWord::kSecondHome)) &&
      (words.has(GGroup::kMotion, GWord::kRapid) || words.has(GGroup::kMotion, GWord::kLinear));
  const bool has_motion = words.has(GGroup::kMotion) && !goes_straight_home &&
                          !words.has(GGroup::kMotion, GWord::kCancelMotion) &&
                          !words.has(GGroup::kMachineCoordinates);
  if (users + static_cast<int>(has_motion) > 1) {
    return fail_at(words.first_column(kAxisWords),
                   "two words of the line would both use X, Y and Z: expected them on lines of "
                   "their own");
  }
  return {};
}

Expected<void> check_feedrate(const LineWords& words, const ModalState& state,
                              bool has_own_feedrate) {
  const int column = words.first_column("XYZIJKR");
  if (words.has('F') && words.value('F') == 0.0) {
    return fail_at(words.column('F'), "F0: expected a feedrate above zero, in units per minute");
  }
  if (state.feed_mode == FeedMode::kInverseTime && !has_own_feedrate && !words.has('F')) {
    return fail_at(column, fmt::format("{} has no feedrate: expected an F word on its own line, "
                                       "for G93 (inverse time) is in force",
                                       name_of(state)));
  }
  if (state.feed_mode == FeedMode::kPerRevolution && !has_own_feedrate) {
    if (state.has_surface_speed) {
      return fail_at(column,
                     "G95 (feed per revolution) beside G96 (surface speed): expected G97, "
                     "for the speed of the spindle is not known");
    }
    if (!(state.spindle_rpm > 0.0)) {
      return fail_at(column, fmt::format("{} has no spindle speed: expected an S word before it, "
                                         "for G95 (feed per revolution) is in force",
                                         name_of(state)));
    }
  }
  if (!(state.feedrate > 0.0)) {
    return fail_at(column, fmt::format("{} has no feedrate: expected an F word on this line or "
                                       "before it",
                                       name_of(state)));
  }
  return {};
}

constexpr std::uint32_t kWithLetters = LineWords::groups_of(GGroup::kDwell, GGroup::kPathMode);
constexpr std::uint32_t kByAxes =
    LineWords::groups_of(GGroup::kSetting, GGroup::kMachineCoordinates, GGroup::kToolLength,
                         GGroup::kMirror, GGroup::kRotation);

}  // namespace

bool sets_by_axes(const LineWords& words) noexcept {
  return (words.g_groups() & kByAxes) != 0 &&
         (uses_axes(words) || words.has(GGroup::kMirror) ||
          words.has(GGroup::kRotation, GWord::kRotation) ||
          words.has(GGroup::kToolLength, GWord::kToolOffset) ||
          words.has(GGroup::kToolLength, GWord::kMoreToolOffset));
}

bool draws_spline(const LineWords& words) noexcept {
  return (words.has(GGroup::kMotion, GWord::kCubicSpline) ||
          words.has(GGroup::kMotion, GWord::kQuadraticSpline)) &&
         words.has_any("XYZIJ");
}

bool asks_for_move(const LineWords& words, const ModalState& state) noexcept {
  return (words.has_any(kAxisWords) && !sets_by_axes(words)) ||
         (state.is_arc() && words.has_any(kOfArcs)) || draws_spline(words);
}

Expected<void> check_words(const LineWords& words, const ModalState& state, bool has_own_feedrate,
                           Notes& notes, std::int64_t line) {
  if ((words.letters() & ~kPlain) != 0) {
    TWIN_CHECK(check_letters(words, state, notes, line));
  }
  if ((words.g_groups() & kWithLetters) != 0) {
    TWIN_CHECK(check_p_and_dwell(words));
  }
  if ((words.g_groups() & kByAxes) != 0 && words.has_any(kAxisWords)) {
    TWIN_CHECK(check_axis_users(words));
  }
  if (state.is_arc() && !sets_by_axes(words)) {
    TWIN_CHECK(check_arc_words(words, state));
    if (const char foreign = words_of(state.plane).foreign; words.has(foreign)) {
      notes.add(NoteKind::kWithoutEffect,
                fmt::format("{}0 of an arc has no effect: it is not of the plane", foreign), line);
    }
  }
  if (!asks_for_move(words, state)) {
    return {};
  }
  if (state.motion == MotionMode::kNone && !draws_spline(words)) {
    return fail_at(words.first_column(kAxisWords),
                   "a place to go to, but no motion in force: expected G00, G01, G02 or G03");
  }
  return state.motion == MotionMode::kRapid || state.is_threading()
             ? Expected<void>()
             : check_feedrate(words, state, has_own_feedrate);
}

}  // namespace twin::gcode
