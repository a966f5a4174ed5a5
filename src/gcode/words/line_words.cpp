#include "gcode/words/line_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "gcode/text/fault.hpp"
#include "gcode/words/lexer.hpp"

namespace twin::gcode {
namespace {

constexpr std::uint32_t kPlainLetters = LineWords::set_of("IJKRXYZ");
constexpr std::string_view kRotary = "ABCUVW";

std::string twice(char letter, double first, double second) {
  return fmt::format(
      "{}{:.10g} and {}{:.10g} on one line belong to the same modal group: expected one", letter,
      first, letter, second);
}

Expected<void> check_number(const Word& word) {
  const LetterKind kind = kind_of(word.letter);
  if (kind == LetterKind::kFeed && word.value < 0.0) {
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

}  // namespace

/// Whether a word needs no look: X Y Z I J K R, not there yet and not left out.
bool LineWords::is_plain(const Word& word) const noexcept {
  const std::uint32_t letter = bit(index(word.letter));
  return (letter & kPlainLetters & ~letters_ & ~ignored_) != 0 && !has(GGroup::kMacro);
}

LineWords::LineWords(std::string_view ignored) {
  for (const char letter : ignored) {
    ignored_ |= bit(index(letter));
  }
}

Expected<void> LineWords::read(std::string_view line, Parameters& parameters) {
  letters_ = g_groups_ = m_groups_ = left_out_ = 0;
  Lexer lexer(line, parameters);
  Word word;
  while (true) {
    switch (lexer.next(word)) {
      case Lexer::Found::kWord:
        if (is_plain(word)) {
          set(word.letter, word.value, word.column);
        } else {
          TWIN_CHECK(add(word));
        }
        break;
      case Lexer::Found::kFault:
        return tl::unexpected<Error>(lexer.take_fault());
      case Lexer::Found::kEnd:
        comment_ = lexer.comment();
        oddity_ = lexer.oddity();
        return {};
    }
  }
}

bool LineWords::read_leniently(std::string_view line, Parameters& parameters) {
  letters_ = g_groups_ = m_groups_ = left_out_ = 0;
  comment_ = {};
  bool is_whole = true;
  Lexer lexer(line, parameters);
  Word word;
  for (Lexer::Found found = lexer.next(word); found != Lexer::Found::kEnd;
       found = lexer.next(word)) {
    if (found == Lexer::Found::kFault) {
      lexer.skip_fault();
      is_whole = false;
    } else if (!add(word) && word.letter >= 'X' && word.letter <= 'Z') {
      is_whole = false;
    }
  }
  return is_whole;
}

/// A word behind G65 or G66 is an argument of the macro, whatever it means elsewhere.
Expected<void> LineWords::add_argument(const Word& word) {
  if (has(word.letter)) {
    return fail_at(word.column,
                   fmt::format("{} appears twice behind G65 or G66: expected each argument once",
                               shown(word.letter)));
  }
  set(word.letter, word.value, word.column);
  return {};
}

Expected<void> LineWords::add(const Word& word) {
  if (word.letter != 'N' && has(GGroup::kMacro) && g(GGroup::kMacro) != GWord::kNoMacroCall) {
    return add_argument(word);
  }
  if (word.letter == 'G') {
    return add_g(word);
  }
  if (word.letter == 'M') {
    return add_m(word);
  }
  if ((ignored_ & bit(index(word.letter))) != 0) {
    left_out_ |= bit(index(word.letter));
    return {};
  }
  if (kind_of(word.letter) == LetterKind::kRefused) {
    if (word.value == 0.0 && kRotary.find(word.letter) != std::string_view::npos) {
      left_out_ |= bit(index(word.letter));  // an axis that never moves stands at 0
      return {};
    }
    return fail_at(word.column, refused_letter(word.letter));
  }
  if (has(word.letter)) {
    return fail_at(word.column,
                   fmt::format("{} appears twice on the line: expected once", shown(word.letter)));
  }
  letters_ |= bit(index(word.letter));
  value_[index(word.letter)] = word.value;
  column_[index(word.letter)] = word.column;
  if (word.letter == 'P') {
    has_point_in_p_ = word.has_point;
  }
  return check_number(word);
}

Expected<void> LineWords::add_g(const Word& word) {
  const auto code = find_g(word.value);
  if (!code) {
    return fail_at(word.column, refused_g(word.value));
  }
  const std::size_t group = index(code->group);
  if (has(code->group)) {
    if (code->word == GWord::kCancelMotion) {
      return {};
    }
    if (g_[group] != GWord::kCancelMotion || code->group != GGroup::kMotion) {
      return fail_at(word.column, twice('G', g_number_[group], word.value));
    }
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
  if (has(code->group) && !may_repeat(code->group)) {
    return fail_at(word.column, twice('M', m_number_[group], word.value));
  }
  m_groups_ |= bit(group);
  m_[group] = code->word;
  m_number_[group] = word.value;
  m_column_[group] = word.column;
  return {};
}

int LineWords::first_g_column() const noexcept {
  int first = 0;
  for (std::size_t group = 0; group < kGGroups; ++group) {
    if ((g_groups_ & bit(group)) != 0 && (first == 0 || g_column_[group] < first)) {
      first = g_column_[group];
    }
  }
  return first;
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

}  // namespace twin::gcode
