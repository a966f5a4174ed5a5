#include <fmt/format.h>

#include <utility>

#include "gcode/interpreter/interpreter.hpp"
#include "gcode/notes.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

// The lines of a NURBS, G05.2 to G05.3 and G06.2.

namespace twin::gcode {

bool Interpreter::concerns_nurbs(const LineWords& words) const noexcept {
  if (nurbs_.is_open() || (state_.motion == MotionMode::kKnotNurbs && words.has_any("XYZKR"))) {
    return true;
  }
  if (!words.has(GGroup::kMotion)) {
    return false;
  }
  const GWord word = words.g(GGroup::kMotion);
  return word == GWord::kNurbs || word == GWord::kNurbsEnd || word == GWord::kKnotNurbs ||
         word == GWord::kKnotNurbsEnd;
}

Expected<void> Interpreter::execute_nurbs(const LineWords& words, MotionMode before,
                                          LineBlocks& blocks) {
  if (words.has_m()) {
    return nurbs_.is_open() ? tl::unexpected<Error>(nurbs_.cut_short("an M word comes"))
                            : fail_at(words.column(GGroup::kMotion),
                                      "an M word beside a NURBS: expected it on a line of its own");
  }
  const bool has_motion = words.has(GGroup::kMotion);
  const GWord word = has_motion ? words.g(GGroup::kMotion) : GWord::kNurbs;
  if (has_motion && (word == GWord::kNurbsEnd || word == GWord::kKnotNurbsEnd)) {
    return end_nurbs(words, before, blocks);
  }
  if (nurbs_.is_open()) {
    const bool goes_on = (word == GWord::kNurbs && before == MotionMode::kNurbs) ||
                         (word == GWord::kKnotNurbs && before == MotionMode::kKnotNurbs &&
                          nurbs_.takes_closing_line(words));
    if (has_motion && !goes_on) {
      return tl::unexpected<Error>(nurbs_.cut_short("another G word of motion comes"));
    }
    TWIN_CHECK(nurbs_.add(words, state_));
  } else if (!has_motion) {
    return fail_at(words.first_column("XYZKR"),
                   fmt::format("the NURBS of line {} is complete: expected a G word of motion",
                               nurbs_.line()));
  } else {
    if (compensation_.is_on() || must_leave_straight_ || state_.is_polar ||
        (state_.feed_mode == FeedMode::kInverseTime && !feedrate_)) {
      return fail_at(words.column(GGroup::kMotion),
                     "a NURBS with G41, G42, G16 or G93 in force: expected G40, G15 and G94, and a "
                     "straight move behind G40");
    }
    const Vec3 place = coordinates().is_identity() ? position_ : programmed_;
    cycle_words_.cancel();
    TWIN_CHECK(nurbs_.open(words, state_, place, line_));
  }
  return nurbs_.is_complete() ? add_nurbs(words.column('K'), blocks) : Expected<void>{};
}

/// G05.3, or G06.3 behind the last knot.
Expected<void> Interpreter::end_nurbs(const LineWords& words, MotionMode before,
                                      LineBlocks& blocks) {
  const int column = words.column(GGroup::kMotion);
  const bool ends_knots = words.g(GGroup::kMotion) == GWord::kKnotNurbsEnd;
  const bool has_begun = before == (ends_knots ? MotionMode::kKnotNurbs : MotionMode::kNurbs);
  if (!has_begun || (!ends_knots && !nurbs_.is_open())) {
    return fail_at(column, fmt::format("{} without {} before it", ends_knots ? "G06.3" : "G05.3",
                                       ends_knots ? "G06.2" : "G05.2"));
  }
  if (words.has_any("ABCDEFHIJKLOPQRSTUVWXYZ")) {
    return fail_at(words.first_column("ABCDEFHIJKLOPQRSTUVWXYZ"),
                   "a word beside the end of a NURBS: expected it on a line of its own");
  }
  if (ends_knots && nurbs_.is_open()) {
    return tl::unexpected<Error>(nurbs_.cut_short("G06.3 comes"));
  }
  return ends_knots ? Expected<void>{} : add_nurbs(column, blocks);
}

Expected<void> Interpreter::add_nurbs(int column, LineBlocks& blocks) {
  if (nurbs_.is_nudged()) {
    notes_->add(NoteKind::kGeometry,
                fmt::format("the first control point of a {} is the position, which is one by "
                            "itself: it is moved by {:g} mm, so that the curve has a tangent there",
                            nurbs_.name(), NurbsCollector::kNudge),
                nurbs_.line());
  }
  const std::int64_t line = nurbs_.line();
  programmed_ = nurbs_.last_point();
  TWIN_TRY(auto curve, nurbs_.close(column, coordinates(), position_));
  const Vec3 end = curve->curve.control_points().back();
  add_curve(std::move(curve), end, line, blocks);
  return {};
}

}  // namespace twin::gcode
