#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace twin::gcode {

/// What a note is about. Notes of one kind are shown together, in this order.
enum class NoteKind : std::uint8_t {
  kDialect,        ///< how the program is read where controls differ
  kFeedrate,       ///< a feedrate above the machine's limit, or one that was missing
  kLongDwell,      ///< a dwell of more than a minute
  kTool,           ///< tools, their lengths and radii
  kProbing,        ///< moves that a probe would end
  kGeometry,       ///< arcs whose ends are off their circle, and the like
  kIgnoredAxis,    ///< words of axes that are left out as the user wishes
  kWithoutEffect,  ///< words that move nothing here
  kText,           ///< text that is no program: after the end, comments left open
  kMessage,        ///< what the program says: MSG, PRINT, DEBUG, LOG
};

/// Name of a kind as JSON and tables show it, as in "without_effect".
std::string_view name_of(NoteKind kind) noexcept;

/// Something that a program's author may want to know; it does not stop the program.
struct Note {
  NoteKind kind = NoteKind::kWithoutEffect;
  std::string text;             ///< one sentence without its full stop
  std::int64_t count = 0;       ///< how often
  std::int64_t first_line = 0;  ///< line where it came first; 0: of no line
};

/// Collects the notes of a program. Notes of the same kind and text are one, with a count.
class Notes {
 public:
  static constexpr std::size_t kMost = 100;  ///< different notes; further ones are only counted

  void add(NoteKind kind, std::string_view text, std::int64_t line);

  const std::vector<Note>& all() const noexcept { return notes_; }  ///< in the order they came
  std::int64_t left_out() const noexcept { return left_out_; }      ///< notes beyond kMost

 private:
  std::vector<Note> notes_;
  std::int64_t left_out_ = 0;
};

}  // namespace twin::gcode
