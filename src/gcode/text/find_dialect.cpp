#include "gcode/text/find_dialect.hpp"

#include <string_view>

#include "gcode/text/characters.hpp"
#include "gcode/text/line_source.hpp"

namespace twin::gcode {
namespace {

constexpr std::int64_t kLinesLookedAt = 2000;

/// Steps over blanks, / and the line number, and puts the rest in upper case without blanks, its
/// comments left out but for the words of active ones.
std::string condensed(std::string_view line) {
  std::string text;
  int depth = 0;
  for (const char c : line) {
    if (c == ';' && depth == 0) {
      break;
    }
    depth += c == '(' ? 1 : 0;
    if (depth == 0 && !is_blank(c)) {
      text.push_back(upper(c));
    }
    depth -= c == ')' && depth > 0 ? 1 : 0;
  }
  std::size_t begin = text.starts_with('/') ? 1 : 0;
  if (at_or_zero(text, begin) == 'N' && is_digit(at_or_zero(text, begin + 1))) {
    ++begin;
    while (is_digit(at_or_zero(text, begin))) {
      ++begin;
    }
  }
  return text.substr(begin);
}

/// True if a text has a word, no digit or point behind it.
bool has_word(std::string_view text, std::string_view word) {
  const std::size_t at = text.find(word);
  const char behind = at == std::string_view::npos ? '0' : at_or_zero(text, at + word.size());
  return at != std::string_view::npos && !is_digit(behind) && behind != '.';
}

std::optional<DialectSign> sign_in(std::string_view text) {
  const auto found = [](Dialect dialect, std::string_view sign) {
    return DialectSign{dialect, std::string(sign), 0};
  };
  const bool has_o = text.starts_with('O');
  if (has_o &&
      (text.find("CALL") != std::string_view::npos || text.find("SUB") != std::string_view::npos ||
       text.find("IF") != std::string_view::npos || text.find("WHILE") != std::string_view::npos ||
       text.find("REPEAT") != std::string_view::npos || text.ends_with("DO"))) {
    return found(Dialect::kLinuxCnc, text.substr(0, 12));
  }
  if (text.find("#<") != std::string_view::npos) {
    return found(Dialect::kLinuxCnc, "#<name>");
  }
  if (has_o || text.starts_with(':')) {
    const bool is_name =
        text.size() > 1 && text.find_first_not_of("0123456789", 1) == std::string_view::npos;
    return is_name ? std::optional(found(Dialect::kFanuc, text)) : std::nullopt;
  }
  for (const std::string_view word : {"GOTO", "THEN"}) {
    if (text.find(word) != std::string_view::npos) {
      return found(Dialect::kFanuc, word);
    }
  }
  if (text.starts_with("WHILE[")) {
    return found(Dialect::kFanuc, "WHILE");
  }
  for (const std::string_view word : {"G65", "G66", "G05.1", "G5.1Q", "G54.1", "G154"}) {
    if (has_word(text, word)) {
      return found(Dialect::kFanuc, word);
    }
  }
  return text.starts_with('$') ? std::optional(found(Dialect::kGrbl, "$")) : std::nullopt;
}

}  // namespace

std::optional<DialectSign> find_dialect(const ProgramText& program) {
  std::optional<DialectSign> first;
  LineSource source(program);
  while (source.line() < kLinesLookedAt) {
    const auto line = source.next();
    if (!line || !*line) {
      break;
    }
    auto sign = sign_in(condensed(**line));
    if (!sign) {
      continue;
    }
    sign->line = source.line();
    if (sign->dialect == Dialect::kLinuxCnc) {
      return sign;
    }
    first = first ? first : sign;
  }
  return first;
}

}  // namespace twin::gcode
