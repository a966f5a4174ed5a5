#include "gcode/text/comment.hpp"

#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"

namespace twin::gcode {
namespace {

constexpr std::string_view kBlanks = " \t";

/// Place of the ) that belongs to the ( at a place, or npos.
std::size_t partner(std::string_view line, std::size_t opened, bool& is_nested) {
  int depth = 0;
  for (std::size_t at = opened; at < line.size(); ++at) {
    if (line[at] == '(') {
      ++depth;
      is_nested = is_nested || depth > 1;
    } else if (line[at] == ')' && --depth == 0) {
      return at;
    }
  }
  return std::string_view::npos;
}

}  // namespace

Expected<Comment> read_comment(std::string_view line, std::size_t at) {
  bool is_nested = false;
  const bool is_bracketed = line[at] == '(';
  const std::size_t closed = is_bracketed ? partner(line, at, is_nested) : std::string_view::npos;
  const bool is_open = is_bracketed && closed == std::string_view::npos;
  Comment comment;
  comment.end = closed == std::string_view::npos ? line.size() : closed + 1;
  comment.text =
      line.substr(at + 1, (closed == std::string_view::npos ? line.size() : closed) - at - 1);
  comment.oddity = is_open     ? CommentOddity::kOpen
                   : is_nested ? CommentOddity::kNested
                               : CommentOddity::kNone;
  for (std::size_t i = 0; i < comment.text.size(); ++i) {
    if (is_control(comment.text[i])) {
      return fail_at(static_cast<int>(at + i) + 2, not_text(comment.text[i]));
    }
  }
  if (is_open) {
    const std::size_t last = line.rfind(')');
    const bool has_other = last != std::string_view::npos && last > at;
    if (has_other && line.find_first_not_of(kBlanks, last + 1) != std::string_view::npos) {
      return fail_at(static_cast<int>(at) + 1,
                     "the comment has more ( than ), and text behind it: expected as many");
    }
  }
  return comment;
}

}  // namespace twin::gcode
