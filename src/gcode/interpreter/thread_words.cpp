#include "gcode/interpreter/thread_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "gcode/interpreter/axis_words.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

constexpr double kSteepest = 80.0;  // angle of a compound slide [deg]

std::string_view thread_name(const ModalState& state) {
  switch (state.motion) {
    case MotionMode::kThread:
      return "G33";
    case MotionMode::kRigidTap:
      return "G33.1";
    default:
      return "G76";
  }
}

tl::unexpected<Error> bad_word(const LineWords& words, char letter, std::string_view expected) {
  return fail_at(words.column(letter), fmt::format("{}{:.10g} of G76: expected {}", letter,
                                                   words.value(letter), expected));
}

Expected<void> check_thread_words(const LineWords& words, int column) {
  for (const char letter : std::string_view("IJK")) {
    if (!words.has(letter)) {
      return fail_at(column,
                     fmt::format("G76 (threading) has no {}: expected P the lead, I the way to the "
                                 "crest, J the first depth and K the full depth",
                                 letter));
    }
  }
  if (words.value('I') == 0.0) {
    return bad_word(words, 'I', "the way from the drive line to the crest, not zero");
  }
  if (!(words.value('J') > 0.0)) {
    return bad_word(words, 'J', "the depth of the first pass, above zero");
  }
  if (!(words.value('K') > words.value('J'))) {
    return bad_word(words, 'K', "the full depth, above J");
  }
  if (words.has('Q') && !(words.value('Q') >= 0.0 && words.value('Q') <= kSteepest)) {
    return bad_word(words, 'Q', "the angle of the compound slide, from 0 to 80 degrees");
  }
  if (words.has('H') && words.value('H') > ThreadingCycle::kMostPasses) {
    return bad_word(words, 'H', "spring cuts, at most 10000");
  }
  if (words.has('E') && words.value('E') < 0.0) {
    return bad_word(words, 'E', "the length of a taper, zero or more");
  }
  if (words.has('L') && !is_whole_in(words.value('L'), 0.0, 3.0)) {
    return bad_word(words, 'L', "0 for no taper, 1 at the entry, 2 at the exit or 3 at both");
  }
  return {};
}

}  // namespace

Expected<double> thread_feedrate(const LineWords& words, const ModalState& state,
                                 const std::optional<double>& own) {
  const std::string_view name = thread_name(state);
  const bool is_cycle = state.motion == MotionMode::kThreadCycle;
  const char letter = is_cycle ? 'P' : 'K';
  const int column =
      words.has(GGroup::kMotion) ? words.column(GGroup::kMotion) : words.first_column("XYZ");
  if (words.has('F') && !is_cycle) {
    return fail_at(
        words.column('F'),
        fmt::format("F beside {}: expected K, the way of one turn of the spindle", name));
  }
  if (!words.has(letter)) {
    return fail_at(column, fmt::format("{} has no lead: expected {} on its line, the way of one "
                                       "turn of the spindle",
                                       name, letter));
  }
  if (!(words.value(letter) > 0.0)) {
    return fail_at(
        words.column(letter),
        fmt::format("{}{:.10g} of {}: expected the way of one turn of the spindle, above "
                    "zero",
                    letter, words.value(letter), name));
  }
  if (own) {
    return *own;
  }
  if (state.has_surface_speed) {
    return fail_at(column, fmt::format("{} beside G96 (surface speed): expected G97, for the speed "
                                       "of the spindle is not known",
                                       name));
  }
  if (!(state.spindle_rpm > 0.0)) {
    return fail_at(column, fmt::format("{} has no spindle speed: expected an S word before it, for "
                                       "its feedrate is {} times S",
                                       name, letter));
  }
  return words.value(letter) * state.unit * state.spindle_rpm / 60.0;
}

Expected<double> return_factor(const LineWords& words) {
  if (!words.has('I')) {
    return 1.0;
  }
  if (!(words.value('I') > 0.0)) {
    return fail_at(words.column('I'), fmt::format("I{:.10g} of G33.1: expected how much faster it "
                                                  "goes back, above zero",
                                                  words.value('I')));
  }
  return words.value('I');
}

Expected<ThreadLine> read_thread_line(const LineWords& words, const ModalState& state,
                                      const Vec3& place, const Vec3& end, double feedrate) {
  const int column =
      words.has(GGroup::kMotion) ? words.column(GGroup::kMotion) : words.first_column("XYZ");
  TWIN_CHECK(check_thread_words(words, column));
  ThreadLine line;
  line.start = place;
  line.end = end;
  line.crest = words.value('I');
  line.first_cut = words.value('J');
  line.height = words.value('K');
  line.degression = std::max(words.value_or_zero('R'), 1.0);
  line.angle = words.value_or_zero('Q') * std::numbers::pi / 180.0;
  line.taper = words.value_or_zero('E');
  const int tapers = static_cast<int>(words.value_or_zero('L'));
  line.has_entry = (tapers & 1) != 0;
  line.has_exit = (tapers & 2) != 0;
  line.spring_cuts = static_cast<std::int64_t>(words.value_or_zero('H'));
  line.unit = state.unit;
  line.feedrate = feedrate;
  if (std::pow(line.height / line.first_cut, line.degression) > ThreadingCycle::kMostPasses) {
    return fail_at(words.column('J'),
                   fmt::format("G76 of depth {:.6g} from {:.6g} on: expected at most {:.0f} passes",
                               line.height, line.first_cut, ThreadingCycle::kMostPasses));
  }
  return line;
}

}  // namespace twin::gcode
