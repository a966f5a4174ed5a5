#include "gcode/words/common_meaning.hpp"

#include <fmt/format.h>

#include "gcode/notes.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

constexpr double kLongDwell = 60.0;  // [s]

/// G70 and G71 are inches and millimetres, but for the cycles of a lathe.
Expected<void> units_of_iso(LineWords& words, std::int64_t line, Notes& notes) {
  const bool is_inch = words.g(GGroup::kUnits) == GWord::kIsoInch;
  if (words.has_any("PQRDUW")) {
    return fail_at(words.column(GGroup::kUnits),
                   fmt::format("G{} (lathe cycle) is not supported: expected a program for a mill",
                               is_inch ? 70 : 71));
  }
  words.set(GGroup::kUnits, is_inch ? GWord::kInch : GWord::kMillimetre);
  notes.add(NoteKind::kDialect,
            is_inch ? "G70 is read as inches (G20)" : "G71 is read as millimetres (G21)", line);
  return {};
}

}  // namespace

Expected<void> to_common_meaning(LineWords& words, Dialect dialect, std::int64_t line,
                                 Notes& notes) {
  if (words.has(GGroup::kUnits, GWord::kIsoInch) ||
      words.has(GGroup::kUnits, GWord::kIsoMillimetre)) {
    TWIN_CHECK(units_of_iso(words, line, notes));
  }
  if (!words.has(GGroup::kDwell)) {
    return {};
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
  return {};
}

}  // namespace twin::gcode
