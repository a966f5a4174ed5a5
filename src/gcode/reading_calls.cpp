#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "gcode/interpreter/polar_words.hpp"
#include "gcode/reading.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/common_meaning.hpp"

// Words that concern more than their line: calls by M98 and G65, states kept by M70.

namespace twin::gcode {
namespace {

/// Numbers of the parameters that the letters behind G65 and G66 set, from A on; 0: none. Source:
/// FANUC, Custom Macro B, "Simple call (G65)", argument specification I.
constexpr std::array<int, 26> kArgumentOf = {1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                             0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

}  // namespace

Expected<void> Reader::Reading::execute_seldom_words() {
  TWIN_CHECK(to_common_meaning(words_, options_.dialect, flow_.main_line(), notes_));
  if (words_.has(GGroup::kMacro)) {
    return execute_macro_word();
  }
  if (words_.has_any(kPolarLetters)) {
    TWIN_CHECK(polar_to_axes(words_, interpreter_.state(), interpreter_.position()));
  }
  if (words_.has(MGroup::kSavedState)) {
    return execute_state_word();
  }
  if (words_.has(MGroup::kSubprogram)) {
    return execute_subprogram_word();
  }
  TWIN_CHECK(execute_rest());
  const auto moves = [](const Block& block) { return block.motion != Motion::kDwell; };
  const auto end = blocks_.block.begin() + static_cast<std::ptrdiff_t>(blocks_.count);
  if (modal_macro_ && flow_.call() == modal_macro_->call &&
      std::any_of(blocks_.block.begin(), end, moves)) {
    return call_macro(*modal_macro_);
  }
  return {};
}

/// M98 and M99, behind all else that their line asks for.
Expected<void> Reader::Reading::execute_subprogram_word() {
  const bool is_call = words_.m(MGroup::kSubprogram) == MWord::kCallSubprogram;
  const auto take = [this](char letter) {
    const auto value =
        words_.has(letter) ? std::optional<double>(words_.value(letter)) : std::nullopt;
    words_.remove(letter);
    return value;
  };
  const int column = words_.column('P');
  const auto number = take('P');
  const auto times = is_call ? take('L') : std::nullopt;
  words_.remove(MGroup::kSubprogram);
  if (!words_.is_empty()) {
    TWIN_CHECK(execute_rest());
  }
  if (!is_call) {
    TWIN_TRY(const bool goes_on, flow_.return_from_numbered(number, std::max(column, 1)));
    if (!goes_on) {
      notes_.add(NoteKind::kText, "M99 in the main program would begin it again; it ends here",
                 flow_.main_line());
      is_at_end_ = true;
    }
    return {};
  }
  if (!number) {
    return fail_at(1, "M98 names no subprogram: expected P");
  }
  return flow_.call_numbered(*number, times, column);
}

/// G65, G66 and G67, behind all else that their line asks for.
Expected<void> Reader::Reading::execute_macro_word() {
  const int column = words_.column(GGroup::kMacro);
  if (words_.g(GGroup::kMacro) == GWord::kNoMacroCall) {
    modal_macro_.reset();
    words_.remove(GGroup::kMacro);
    return words_.is_empty() ? Expected<void>() : execute_seldom_words();
  }
  const bool is_modal = words_.g(GGroup::kMacro) == GWord::kModalMacroCall;
  if (options_.dialect != Dialect::kFanuc) {
    return fail_at(column, fmt::format("G{} (macro call) is FANUC's: expected --dialect fanuc",
                                       is_modal ? 66 : 65));
  }
  if (!words_.has('P')) {
    return fail_at(column, fmt::format("G{} names no macro: expected P", is_modal ? 66 : 65));
  }
  ModalMacro macro;
  macro.number = words_.value('P');
  macro.column = words_.column('P');
  macro.call = flow_.call();
  if (words_.has('L')) {
    macro.times = words_.value('L');
  }
  macro.arguments.fill(kNullValue);
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (!words_.has(letter) || letter == 'P' || letter == 'L' || letter == 'N') {
      continue;
    }
    const int argument = kArgumentOf[static_cast<std::size_t>(letter - 'A')];
    if (argument == 0) {
      return fail_at(words_.column(letter),
                     fmt::format("{} behind G65 or G66: expected arguments A to F, H to K, M, Q to "
                                 "Z",
                                 letter));
    }
    macro.arguments[static_cast<std::size_t>(argument) - 1] = words_.value(letter);
  }
  if (words_.has_m() || words_.has_other_than(GGroup::kMacro)) {
    return fail_at(column, "another G or M word beside G65 or G66: expected it on its own line");
  }
  if (is_modal) {
    modal_macro_ = macro;
    return {};
  }
  return call_macro(macro);
}

Expected<void> Reader::Reading::call_macro(const ModalMacro& macro) {
  return flow_.call_macro(macro.number, macro.times, macro.arguments, macro.column);
}

/// M70 to M73. A state belongs to the call that keeps it.
Expected<void> Reader::Reading::execute_state_word() {
  const MWord word = words_.m(MGroup::kSavedState);
  const int column = words_.column(MGroup::kSavedState);
  words_.remove(MGroup::kSavedState);
  words_.remove('N');
  if (!words_.is_empty()) {
    return fail_at(column, "another word beside M70 to M73: expected them on lines of their own");
  }
  const std::uint64_t call = flow_.call();
  const bool has_state = !states_.empty() && states_.back().call == call;
  if (word == MWord::kSaveState || word == MWord::kSaveStateForReturn) {
    TWIN_TRY(const SavedState state, interpreter_.saved_state(column));
    if (!has_state) {
      states_.emplace_back();
    }
    states_.back() = {call, word == MWord::kSaveStateForReturn, true, state};
    return {};
  }
  if (word == MWord::kForgetState) {
    if (has_state) {
      states_.back().is_valid = false;
    }
    return {};
  }
  if (!has_state || !states_.back().is_valid) {
    return fail_at(column,
                   "M72 restores a state that was not kept: expected M70 before it, in the "
                   "same subroutine");
  }
  TWIN_CHECK(interpreter_.saved_state(column));
  interpreter_.restore(states_.back().state);
  return {};
}

/// Restores what M73 has kept for calls that have returned.
void Reader::Reading::leave_ended_calls() {
  while (!states_.empty() && !flow_.is_running(states_.back().call)) {
    const KeptState& kept = states_.back();
    if (kept.is_for_return && kept.is_valid) {
      interpreter_.restore(kept.state);
    }
    states_.pop_back();
  }
}

}  // namespace twin::gcode
