#include "gcode/flow/control_line.hpp"

#include <fmt/format.h>

#include <array>

#include "gcode/text/comment.hpp"
#include "gcode/text/fault.hpp"

namespace twin::gcode {
namespace {

struct NamedKeyword {
  std::string_view name;
  Keyword keyword;
};

constexpr std::array kOWords = {
    NamedKeyword{"SUB", Keyword::kSub},           NamedKeyword{"ENDSUB", Keyword::kEndSub},
    NamedKeyword{"CALL", Keyword::kCall},         NamedKeyword{"CALLSUB", Keyword::kCall},
    NamedKeyword{"RETURN", Keyword::kReturn},     NamedKeyword{"IF", Keyword::kIf},
    NamedKeyword{"ELSEIF", Keyword::kElseIf},     NamedKeyword{"ELSE", Keyword::kElse},
    NamedKeyword{"ENDIF", Keyword::kEndIf},       NamedKeyword{"WHILE", Keyword::kWhile},
    NamedKeyword{"ENDWHILE", Keyword::kEndWhile}, NamedKeyword{"DO", Keyword::kDo},
    NamedKeyword{"REPEAT", Keyword::kRepeat},     NamedKeyword{"ENDREPEAT", Keyword::kEndRepeat},
    NamedKeyword{"BREAK", Keyword::kBreak},       NamedKeyword{"CONTINUE", Keyword::kContinue},
};

constexpr std::array kMacroWords = {
    NamedKeyword{"IF", Keyword::kMacroIf}, NamedKeyword{"WHILE", Keyword::kMacroWhile},
    NamedKeyword{"DO", Keyword::kMacroDo}, NamedKeyword{"END", Keyword::kMacroEnd},
    NamedKeyword{"GOTO", Keyword::kGoto},
};

constexpr std::size_t kLongestKeyword = 9;

int column_in(std::size_t at) noexcept { return static_cast<int>(at) + 1; }

/// Reads letters whatever blanks are between them, up to one more than the longest keyword has.
std::string read_letters(std::string_view line, std::size_t& at) {
  std::string word;
  while (word.size() <= kLongestKeyword) {
    std::size_t next = at;
    skip_blanks(line, next);
    if (!is_letter(at_or_zero(line, next))) {
      break;
    }
    word.push_back(upper(line[next]));
    at = next + 1;
  }
  return word;
}

/// Steps over a bracketed expression or a parameter without reading it.
void step_over_value(std::string_view line, std::size_t& at) noexcept {
  skip_blanks(line, at);
  while (at_or_zero(line, at) == '#') {
    ++at;
    skip_blanks(line, at);
  }
  if (at_or_zero(line, at) == '<') {
    at = std::min(line.find('>', at), line.size() - 1) + 1;
  } else if (at_or_zero(line, at) == '[') {
    int depth = 0;
    do {
      depth += line[at] == '[' ? 1 : line[at] == ']' ? -1 : 0;
      ++at;
    } while (at < line.size() && depth > 0);
  } else {
    while (is_digit(at_or_zero(line, at))) {
      ++at;
    }
  }
}

Expected<void> read_label(std::string_view line, std::size_t& at, ControlLine& control) {
  skip_blanks(line, at);
  control.label_begin = at;
  const char c = at_or_zero(line, at);
  if (c == '<') {
    const std::size_t end = line.find('>', at);
    if (end == std::string_view::npos) {
      return fail_at(column_in(at), "the name of a subroutine has no end: expected >");
    }
    for (const char letter : line.substr(at + 1, end - at - 1)) {
      if (!is_blank(letter)) {
        control.label.push_back(
            letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter);
      }
    }
    at = end + 1;
    return {};
  }
  if (c == '[' || c == '#') {
    step_over_value(line, at);
    return {};
  }
  while (is_digit(at_or_zero(line, at))) {
    if (line[at] != '0' || !control.label.empty()) {
      control.label.push_back(line[at]);
    }
    ++at;
  }
  if (at == control.label_begin) {
    return fail_at(column_in(at), "O has no number: expected a number, <name> or [expression]");
  }
  if (control.label.empty()) {
    control.label = "0";
  }
  return {};
}

Expected<ControlLine> read_o_line(std::string_view line, std::size_t at) {
  ControlLine control;
  ++at;
  TWIN_CHECK(read_label(line, at, control));
  control.rest = at;
  if (is_rest_empty(line, at)) {
    return control;
  }
  skip_comments(line, at);
  control.keyword_begin = at;
  const std::string word = read_letters(line, at);
  for (const NamedKeyword& known : kOWords) {
    if (known.name == word) {
      control.keyword = known.keyword;
      control.rest = at;
      return control;
    }
  }
  return fail_at(column_in(control.keyword_begin),
                 fmt::format("'{}' behind an O-word: expected sub, endsub, call, return, if, "
                             "elseif, else, endif, while, endwhile, do, repeat, endrepeat, break "
                             "or continue",
                             start_of(line.substr(control.keyword_begin))));
}

}  // namespace

std::size_t begin_of_words(std::string_view line, std::size_t at) noexcept {
  skip_comments(line, at);
  if (at_or_zero(line, at) == '/') {
    ++at;
    skip_comments(line, at);
  }
  if (upper(at_or_zero(line, at)) != 'N') {
    return at;
  }
  std::size_t behind = at + 1;
  skip_blanks(line, behind);
  if (!is_digit(at_or_zero(line, behind))) {
    return at;
  }
  while (is_digit(at_or_zero(line, behind)) || at_or_zero(line, behind) == '.') {
    ++behind;
  }
  skip_comments(line, behind);
  return behind;
}

Expected<ControlLine> read_control_line(std::string_view line, std::size_t at) {
  if (upper(line[at]) == 'O' || line[at] == ':') {
    return read_o_line(line, at);
  }
  ControlLine control;
  control.keyword_begin = at;
  std::size_t behind = at;
  const std::string word = read_letters(line, behind);
  for (const NamedKeyword& known : kMacroWords) {
    if (known.name == word) {
      control.keyword = known.keyword;
      control.rest = behind;
      return control;
    }
  }
  return fail_at(column_in(at), fmt::format("{} has no number: expected one, found '{}'",
                                            upper(line[at]), start_of(line.substr(at + 1))));
}

std::string shown_label(std::string_view label) {
  return !label.empty() && is_digit(label.front()) ? fmt::format("o{}", label)
                                                   : fmt::format("o<{}>", label);
}

std::string_view name_of(Keyword keyword) noexcept {
  constexpr std::string_view kNames[] = {
      "name",  "sub",      "endsub", "call",     "return", "if",     "elseif",
      "else",  "endif",    "while",  "endwhile", "do",     "repeat", "endrepeat",
      "break", "continue", "IF",     "WHILE",    "DO",     "END",    "GOTO"};
  return kNames[static_cast<std::size_t>(keyword)];
}

void skip_comments(std::string_view line, std::size_t& at) noexcept {
  while (at < line.size() && (is_blank(line[at]) || line[at] == '(' || line[at] == ';')) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    const auto comment = read_comment(line, at);
    if (!comment) {
      return;
    }
    at = comment->end;
  }
}

bool is_rest_empty(std::string_view line, std::size_t at) noexcept {
  skip_comments(line, at);
  return at == line.size();
}

}  // namespace twin::gcode
