#include <fmt/format.h>

#include <string_view>

#include "gcode/interpreter/interpreter.hpp"
#include "gcode/interpreter/line_check.hpp"
#include "gcode/notes.hpp"
#include "gcode/words/line_words.hpp"

// Words of a line that move nothing here, which is noted.

namespace twin::gcode {

void Interpreter::note_words_without_effect(const LineWords& words) {
  const auto note = [this](bool is_there, std::string_view text) {
    if (is_there) {
      notes_->add(NoteKind::kWithoutEffect, text, line_);
    }
  };
  note(words.has(GGroup::kPathMode) && words.has('Q'),
       "Q of G64 has no effect: short lines are followed within P");
  note(words.has(GGroup::kSpindleMode), "G96 and G97 have no effect: the spindle is not modelled");
  note(words.has(GGroup::kSmoothness, GWord::kSmoothness),
       "G187 has no effect: the path tolerance is that of G64 P");
  note(words.has(GGroup::kSmoothness, GWord::kLookAheadLimit) ||
           (words.has(GGroup::kDiameter) && words.has('P')),
       "G103 and G08 P have no effect: look-ahead is always on");
  note((words.has(GGroup::kMotion, GWord::kCubicSpline) ||
        words.has(GGroup::kMotion, GWord::kQuadraticSpline)) &&
           !draws_spline(words),
       "G05 P and G05.1 Q have no effect: look-ahead is always on");
  if (!words.has_m()) {
    return;
  }
  note(words.has(MGroup::kOverride), "M48 to M53 have no effect: overrides are the operator's");
  note(words.has(MGroup::kInputOutput),
       "M62 to M68 have no effect: there are no inputs and outputs");
  note(words.has(MGroup::kClamp), "M10 and M11 have no effect: there are no clamps");
  if (words.has(MGroup::kMachineFunction)) {
    note(true, fmt::format("M{:g} has no effect: it is a function of the machine's builder",
                           words.m_number(MGroup::kMachineFunction)));
  }
  note(words.has(MGroup::kUserCommand), "M100 to M199 have no effect: no program is started");
}

}  // namespace twin::gcode
