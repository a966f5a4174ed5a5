#include "gcode/word_rules.hpp"

#include <fmt/format.h>

#include <string_view>

#include "gcode/lexer.hpp"
#include "gcode/line_words.hpp"
#include "gcode/modal_state.hpp"

namespace twin::gcode {
namespace {

constexpr std::string_view kAxisWords = "XYZ";
constexpr std::string_view kCentre = "IJK";
constexpr std::string_view kOfArcs = "IJKR";

std::string_view name_of(MotionMode motion) {
  switch (motion) {
    case MotionMode::kLinear:
      return "G01";
    case MotionMode::kArcClockwise:
      return "G02";
    case MotionMode::kArcCounterClockwise:
      return "G03";
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

Expected<void> check_p_and_dwell(const LineWords& words) {
  const bool is_dwell = words.has(GGroup::kDwell);
  const bool is_continuous = words.has(GGroup::kPathMode, GWord::kContinuous);
  if (words.has('P') && !is_dwell && !is_continuous) {
    return fail_at(words.column('P'), "P needs G04 or G64 on its line");
  }
  if (words.has('P') && is_dwell && is_continuous) {
    return fail_at(words.column('P'),
                   "P with both G04 and G64: expected them on lines of their own");
  }
  if (is_dwell && !words.has('P')) {
    return fail_at(words.column(GGroup::kDwell), "G04 has no time: expected P, in seconds");
  }
  if (is_dwell && words.has_any("XYZIJKR")) {
    return fail_at(words.first_column("XYZIJKR"),
                   "a move beside G04: expected P, in seconds, and no other word");
  }
  return {};
}

Expected<void> check_arc_words(const LineWords& words, const ModalState& state) {
  if (!words.has_any(kOfArcs)) {
    if (words.has_any(kAxisWords)) {
      return fail_at(words.first_column(kAxisWords),
                     fmt::format("{} has no centre: expected {}, or R", name_of(state.motion),
                                 words_of(state.plane).offsets));
    }
    return {};
  }
  if (words.has('R') && words.has_any(kCentre)) {
    return fail_at(words.column('R'), fmt::format("R beside I, J or K: expected {}, or R, not both",
                                                  words_of(state.plane).offsets));
  }
  const PlaneWords plane = words_of(state.plane);
  if (words.has(plane.foreign)) {
    return fail_at(words.column(plane.foreign),
                   fmt::format("{} does not belong to the plane of {}: expected {}", plane.foreign,
                               plane.code, plane.offsets));
  }
  return {};
}

}  // namespace

bool asks_for_move(const LineWords& words, const ModalState& state) noexcept {
  return words.has_any(kAxisWords) || (state.is_arc() && words.has_any(kOfArcs));
}

Expected<void> check_words(const LineWords& words, const ModalState& state) {
  if (words.has('L')) {
    return fail_at(words.column('L'),
                   "L (repeat count, or order of a NURBS) needs G05.2 on its line");
  }
  if (words.has('P') || words.has(GGroup::kDwell)) {
    TWIN_CHECK(check_p_and_dwell(words));
  }
  if (!state.is_arc() && words.has_any(kOfArcs)) {
    const int column = words.first_column(kOfArcs);
    return fail_at(column, "an arc's I, J, K or R needs G02 or G03 in force");
  }
  if (state.is_arc()) {
    TWIN_CHECK(check_arc_words(words, state));
  }
  if (!asks_for_move(words, state)) {
    return {};
  }
  if (state.motion == MotionMode::kNone) {
    return fail_at(words.first_column(kAxisWords),
                   "a place to go to, but no motion in force: expected G00, G01, G02 or G03");
  }
  if (state.motion != MotionMode::kRapid && !(state.feedrate > 0.0)) {
    return fail_at(words.first_column("XYZIJKR"),
                   fmt::format("{} has no feedrate: expected an F word on this line or before it",
                               name_of(state.motion)));
  }
  return {};
}

}  // namespace twin::gcode
