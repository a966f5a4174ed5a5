#include "gcode/notes.hpp"

namespace twin::gcode {

std::string_view name_of(NoteKind kind) noexcept {
  constexpr std::string_view kNames[] = {"dialect", "feedrate", "long_dwell",   "tool",
                                         "probing", "geometry", "ignored_axis", "without_effect",
                                         "text",    "message"};
  return kNames[static_cast<std::size_t>(kind)];
}

void Notes::add(NoteKind kind, std::string_view text, std::int64_t line) {
  for (Note& note : notes_) {
    if (note.kind == kind && note.text == text) {
      ++note.count;
      return;
    }
  }
  if (notes_.size() == kMost) {
    ++left_out_;
    return;
  }
  notes_.push_back({kind, std::string(text), 1, line});
}

}  // namespace twin::gcode
