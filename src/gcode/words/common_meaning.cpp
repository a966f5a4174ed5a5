#include "gcode/words/common_meaning.hpp"

#include <fmt/format.h>

#include "gcode/notes.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

constexpr double kLongDwell = 60.0;  // [s]

}  // namespace

void to_common_meaning(LineWords& words, Dialect dialect, std::int64_t line, Notes& notes) {
  if (!words.has(GGroup::kDwell)) {
    return;
  }
  if (dialect == Dialect::kFanuc) {
    if (!words.has('P') && words.has('X')) {
      words.rename('X', 'P');
    } else if (words.has('P') && !words.has_point_in_p()) {
      words.set_value('P', 1e-3 * words.value('P'));
      notes.add(NoteKind::kDialect, "P of G04 without a decimal point is read as milliseconds",
                line);
    }
  }
  if (words.has('P') && words.value('P') > kLongDwell) {
    notes.add(
        NoteKind::kLongDwell,
        fmt::format("G04 rests for {:g} s, more than a minute{}", words.value('P'),
                    dialect == Dialect::kFanuc ? "" : ": with --dialect fanuc P is milliseconds"),
        line);
  }
}

}  // namespace twin::gcode
