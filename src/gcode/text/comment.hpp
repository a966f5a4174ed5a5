#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/error.hpp"

namespace twin::gcode {

/// What is unusual about a comment, for a note.
enum class CommentOddity : std::uint8_t {
  kNone,
  kNested,  ///< parentheses within
  kOpen,    ///< without its ), so that it goes to the end of the line
};

struct Comment {
  std::string_view text;  ///< without its parentheses or semicolon
  std::size_t end = 0;    ///< place behind it in the line
  CommentOddity oddity = CommentOddity::kNone;
};

/// Reads the comment that begins at a place of a line, with ( or ;.
///
/// A comment from ( goes to the ) that belongs to it; without one, to the end of the line, unless
/// there is text behind another ) of that line, which a control that ends comments at the first )
/// would execute.
///
/// @returns an error with its column for control characters and for parentheses that may mean two
///          things
Expected<Comment> read_comment(std::string_view line, std::size_t at);

}  // namespace twin::gcode
