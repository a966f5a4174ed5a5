#include "gcode/line_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "gcode/lexer.hpp"
#include "gcode/modal_state.hpp"

namespace twin::gcode {
namespace {

std::string twice(char letter, double first, double second) {
  return fmt::format(
      "{}{:.10g} and {}{:.10g} on one line belong to the same modal group: expected one", letter,
      first, letter, second);
}

Expected<void> check_number(const Word& word) {
  const LetterKind kind = kind_of(word.letter);
  if (kind == LetterKind::kPositive && !(word.value > 0.0)) {
    return fail_at(word.column, fmt::format("{}{:.10g}: expected a feedrate above zero, in units "
                                            "per minute",
                                            word.letter, word.value));
  }
  if (kind == LetterKind::kNotNegative && word.value < 0.0) {
    return fail_at(word.column,
                   fmt::format("{}{:.10g}: expected zero or more", word.letter, word.value));
  }
  if (kind == LetterKind::kCount && (word.value < 0.0 || word.value != std::floor(word.value))) {
    return fail_at(word.column, fmt::format("{}{:.10g}: expected a whole number, zero or more",
                                            word.letter, word.value));
  }
  return {};
}

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

Expected<void> LineWords::read(std::string_view line) {
  letters_ = g_groups_ = m_groups_ = 0;
  Lexer lexer(line);
  while (true) {
    TWIN_TRY(const auto word, lexer.next());
    if (!word) {
      return {};
    }
    TWIN_CHECK(add(*word));
  }
}

Expected<void> LineWords::add(const Word& word) {
  if (word.letter == 'G') {
    return add_g(word);
  }
  if (word.letter == 'M') {
    return add_m(word);
  }
  if (kind_of(word.letter) == LetterKind::kRefused) {
    return fail_at(word.column, refused_letter(word.letter));
  }
  if (has(word.letter)) {
    return fail_at(word.column,
                   fmt::format("{} appears twice on the line: expected once", word.letter));
  }
  letters_ |= bit(index(word.letter));
  value_[index(word.letter)] = word.value;
  column_[index(word.letter)] = word.column;
  return check_number(word);
}

Expected<void> LineWords::add_g(const Word& word) {
  const auto code = find_g(word.value);
  if (!code) {
    return fail_at(word.column, refused_g(word.value));
  }
  const std::size_t group = index(code->group);
  if (has(code->group)) {
    return fail_at(word.column, twice('G', g_number_[group], word.value));
  }
  g_groups_ |= bit(group);
  g_[group] = code->word;
  g_number_[group] = word.value;
  g_column_[group] = word.column;
  return {};
}

Expected<void> LineWords::add_m(const Word& word) {
  const auto code = find_m(word.value);
  if (!code) {
    return fail_at(word.column, refused_m(word.value));
  }
  const std::size_t group = index(code->group);
  if (has(code->group)) {
    return fail_at(word.column, twice('M', m_number_[group], word.value));
  }
  m_groups_ |= bit(group);
  m_[group] = code->word;
  m_number_[group] = word.value;
  return {};
}

bool LineWords::has_any(std::string_view letters) const noexcept {
  for (const char letter : letters) {
    if (has(letter)) {
      return true;
    }
  }
  return false;
}

int LineWords::first_column(std::string_view letters) const noexcept {
  int first = 0;
  for (const char letter : letters) {
    if (has(letter) && (first == 0 || column(letter) < first)) {
      first = column(letter);
    }
  }
  return first;
}

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
