#include "gcode/reading.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "core/units.hpp"
#include "gcode/interpreter/tool_table.hpp"
#include "gcode/start.hpp"
#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/text/find_dialect.hpp"
#include "gcode/values/message.hpp"

namespace twin::gcode {
namespace {

constexpr std::uint32_t kSeldomGroups =
    LineWords::groups_of(GGroup::kDwell, GGroup::kMacro, GGroup::kUnits);

constexpr double kProbed = 5061.0;        // X; Y and Z follow
constexpr double kProbedByMach = 2000.0;  // the same
constexpr double kHasTripped = 5070.0;

/// The options with the dialect that the program's text shows, of which a note is made.
ReaderOptions with_dialect(ReaderOptions options, const ProgramText& program, Notes& notes) {
  if (options.dialect != Dialect::kAuto) {
    return options;
  }
  options.dialect = Dialect::kLinuxCnc;
  options.guesses_centres = true;
  const auto sign = find_dialect(program);
  if (sign && sign->dialect != Dialect::kLinuxCnc) {
    options.dialect = sign->dialect;
    notes.add(NoteKind::kDialect,
              fmt::format("read as {} for its {}; --dialect says otherwise",
                          options.dialect == Dialect::kFanuc ? "FANUC's dialect" : "grbl's dialect",
                          sign->sign),
              sign->line);
  }
  return options;
}

/// The options with the place where the machine stands at the start.
ReaderOptions with_start(ReaderOptions options, const ProgramText& program) {
  options.start = start_of(program, options);
  options.lifts_start = false;
  return options;
}

/// The options with the tools of their file. @param error  why that cannot be read
ReaderOptions with_tools(ReaderOptions options, std::optional<Error>& error) {
  if (options.tools || options.tool_table.empty()) {
    return options;
  }
  auto table = ToolTable::read(options.tool_table);
  if (table) {
    options.tools = std::make_shared<const ToolTable>(*std::move(table));
  } else {
    error = std::move(table.error());
    error->code = ErrorCode::kFile;
  }
  return options;
}

}  // namespace

Reader::Reading::Reading(const ProgramText& program, const ReaderOptions& options)
    : options_(with_tools(with_dialect(with_start(options, program), program, notes_), error_)),
      interpreter_(options_, notes_),
      machine_(interpreter_),
      source_(machine_, flow_),
      parameters_(&source_, options_.dialect),
      flow_(program, options_, parameters_, notes_),
      words_(options_.ignored_axes) {
  if (auto given = parameters_.set_given(options_.parameters); !given && !error_) {
    error_ = std::move(given.error());
    error_->code = ErrorCode::kFile;
  }
}

Expected<std::optional<Block>> Reader::Reading::next() {
  if (error_) {
    return tl::unexpected<Error>(*error_);
  }
  while (next_block_ == blocks_.count) {
    if (interpreter_.has_more()) {
      interpreter_.more(blocks_);
      next_block_ = 0;
      continue;
    }
    if (is_at_end_) {
      if (auto finished = finish(); !finished) {
        return stop_with(std::move(finished.error()));
      }
      if (interpreter_.has_more()) {
        continue;
      }
      return std::nullopt;
    }
    if (auto read = read_line(); !read) {
      return stop_with(std::move(read.error()));
    }
  }
  Block& block = blocks_.block[next_block_++];
  has_moved_ = has_moved_ || block.motion != Motion::kDwell;
  return Expected<std::optional<Block>>(tl::in_place, std::in_place, std::move(block));
}

/// Reads one line into blocks_, which is empty if the line does not move.
Expected<void> Reader::Reading::read_line() {
  next_block_ = blocks_.count = 0;
  text_ = {};
  ExecutedLine line;
  TWIN_TRY(const bool is_line, flow_.next(line));
  if (!is_line) {
    is_at_end_ = true;
    return {};
  }
  text_ = line.text;
  if (!states_.empty()) {
    leave_ended_calls();
  }
  Expected<void> done = execute(line.text);
  if (!done && done.error().column > 0) {
    done.error().column += static_cast<int>(line.stepped_over);
  }
  return done;
}

Expected<void> Reader::Reading::execute(std::string_view text) {
  if (text.starts_with('$')) {
    return execute_system_command(text);
  }
  TWIN_CHECK(words_.read(text, parameters_));
  if (parameters_.has_kept()) {
    parameters_.commit();
  }
  if (parameters_.has_unknown()) {
    notes_.add(NoteKind::kFeedrate,
               fmt::format("#<{}> of F or S is 0: only LinuxCNC's machine knows it",
                           parameters_.take_unknown()),
               flow_.main_line());
  }
  if (words_.is_unusual()) {
    note_what_is_unusual();
  }
  if (words_.is_empty()) {
    return {};
  }
  if ((words_.g_groups() & kSeldomGroups) != 0 || words_.has(MGroup::kSubprogram) ||
      words_.has(MGroup::kSavedState) || words_.has_any(kPolarLetters) || modal_macro_) {
    return execute_seldom_words();
  }
  return execute_rest();
}

/// A line that grbl does not take as a block: settings, homing, jogging.
Expected<void> Reader::Reading::execute_system_command(std::string_view text) {
  const char kind = upper(at_or_zero(text, 1));
  if (kind == 'J' || (kind == 'H' && has_moved_)) {
    return fail_at(1, kind == 'J'
                          ? "$J (jogging) is not supported: expected G00 or G01"
                          : "$H (homing) behind a move is not supported: expected it before "
                            "the first, or G28");
  }
  notes_.add(NoteKind::kWithoutEffect, "lines with $ have no effect: they are commands to grbl",
             flow_.main_line());
  return {};
}

/// Gives the words to the interpreter.
Expected<void> Reader::Reading::execute_rest() {
  TWIN_CHECK(interpreter_.execute(words_, flow_.main_line(), blocks_));
  is_at_end_ = blocks_.is_end;
  if (words_.has('F') || (blocks_.count > 0 && interpreter_.state().has_default_feedrate())) {
    note_feedrate();
  }
  if (interpreter_.has_probed()) {
    keep_probed();
  }
  return {};
}

/// Puts the end of a probing move where programs look for it: #5061 to #5063, and that the probe
/// has not tripped into #5070; Mach has #2000 to #2002.
void Reader::Reading::keep_probed() {
  const auto probed = interpreter_.take_probed();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    static_cast<void>(
        parameters_.set_later(kProbed + static_cast<double>(axis), probed->place[axis], 0));
    if (probed->is_skip && options_.dialect != Dialect::kFanuc) {
      static_cast<void>(
          parameters_.set_later(kProbedByMach + static_cast<double>(axis), probed->place[axis], 0));
    }
  }
  static_cast<void>(parameters_.set_later(kHasTripped, 0.0, 0));
  parameters_.commit();
}

/// Notes an F above what the machine can, and moves that have none.
void Reader::Reading::note_feedrate() {
  if (options_.feedrate) {
    return;
  }
  const ModalState& state = interpreter_.state();
  if (words_.has('F') && options_.largest_feedrate > 0.0 &&
      state.feedrate > options_.largest_feedrate * (1.0 + 1e-9) &&
      state.feed_mode != FeedMode::kInverseTime) {
    notes_.add(NoteKind::kFeedrate,
               fmt::format("F is above the machine's {:g} mm/min, which hold",
                           units::mm_per_min_from_mm_per_s(options_.largest_feedrate)),
               flow_.main_line());
  }
  if (state.has_default_feedrate() && blocks_.count > 0 &&
      blocks_.block[blocks_.count - 1].feedrate > 0.0) {
    notes_.add(NoteKind::kFeedrate,
               fmt::format("{}: {:g} mm/min of program.default_feedrate hold",
                           state.has_feed_word ? "F0" : "no F yet",
                           units::mm_per_min_from_mm_per_s(options_.default_feedrate)),
               flow_.main_line());
  }
}

void Reader::Reading::note_what_is_unusual() {
  const std::int64_t line = flow_.main_line();
  if (words_.oddity() != CommentOddity::kNone) {
    notes_.add(NoteKind::kText,
               words_.oddity() == CommentOddity::kOpen
                   ? "a comment without its ) goes to the end of its line"
                   : "a comment within a comment ends with the outer one",
               line);
  }
  for (const char letter : std::string_view("ABCEUVW")) {
    if (words_.has_left_out(letter)) {
      const bool is_ignored = options_.ignored_axes.find(letter) != std::string::npos;
      notes_.add(NoteKind::kIgnoredAxis,
                 is_ignored ? fmt::format("words of axis {} are left out", letter)
                            : fmt::format("{}0 moves nothing: there is no axis {}", letter, letter),
                 line);
    }
  }
  if (const auto message = message_of(words_.comment(), parameters_)) {
    notes_.add(NoteKind::kMessage, *message, line);
  }
}

Expected<void> Reader::Reading::finish() {
  TWIN_CHECK(interpreter_.finish());
  if (has_moved_ || has_erred_ || interpreter_.has_more()) {
    return {};
  }
  if (flow_.line() == 0) {
    return fail_at(0, "the file is empty: expected an NC program");
  }
  return fail_at(0, "the program holds no motion: expected at least one move by G00 to G03");
}

}  // namespace twin::gcode
