#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "gcode/text/characters.hpp"

namespace twin::gcode {

/// What a line of flow control does. Those before kMacroIf are O-words of RS274/NGC, the others
/// are FANUC's custom macro B.
enum class Keyword : std::uint8_t {
  kName,  ///< O1234 or :1234 alone: the name of the program or subprogram that begins here
  kSub,
  kEndSub,
  kCall,
  kReturn,
  kIf,
  kElseIf,
  kElse,
  kEndIf,
  kWhile,  ///< before a body, or behind the body of kDo
  kEndWhile,
  kDo,
  kRepeat,
  kEndRepeat,
  kBreak,
  kContinue,
  kMacroIf,     ///< IF [condition] GOTO n, IF [condition] THEN assignment
  kMacroWhile,  ///< WHILE [condition] DO n
  kMacroDo,     ///< DO n, without end
  kMacroEnd,    ///< END n
  kGoto,        ///< GOTO n
};

/// A line of flow control, taken apart but for its values.
struct ControlLine {
  Keyword keyword = Keyword::kName;
  std::string label;              ///< number without zeros at its front, or name in lower case;
                                  ///< empty where it is computed
  std::size_t label_begin = 0;    ///< place of the label in the line
  std::size_t keyword_begin = 0;  ///< place of the keyword
  std::size_t rest = 0;           ///< place behind the keyword
};

/// Place in a line where its first word begins: behind blanks, comments, the / of block delete and
/// the line number N.
std::size_t begin_of_words(std::string_view line, std::size_t at) noexcept;

/// True if a line of flow control may begin at a place: O or :, or two letters in a row.
inline bool may_be_control(std::string_view line, std::size_t at) noexcept {
  switch (line[at]) {
    case 'O':
    case 'o':
    case ':':
      return true;
    case 'I':
    case 'i':
    case 'W':
    case 'w':
    case 'D':
    case 'd':
    case 'E':
    case 'e':
    case 'G':
    case 'g':
      return is_letter(at_or_zero(line, at + 1));
    default:
      return false;
  }
}

/// Takes a line of flow control apart.
///
/// @param at  where its words begin
/// @returns an error with its column if it is none after all
Expected<ControlLine> read_control_line(std::string_view line, std::size_t at);

/// "o100" or "o<name>", as messages show a label.
std::string shown_label(std::string_view label);

/// The keyword as it is written, in lower case for O-words.
std::string_view name_of(Keyword keyword) noexcept;

/// Steps over blanks and comments.
void skip_comments(std::string_view line, std::size_t& at) noexcept;

/// True if nothing but blanks and comments is behind a place.
bool is_rest_empty(std::string_view line, std::size_t at) noexcept;

}  // namespace twin::gcode
