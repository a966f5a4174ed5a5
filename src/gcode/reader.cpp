#include "gcode/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/units.hpp"
#include "gcode/flow/flow.hpp"
#include "gcode/interpreter/interpreter.hpp"
#include "gcode/interpreter/machine_parameters.hpp"
#include "gcode/interpreter/tool_table.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/text/find_dialect.hpp"
#include "gcode/values/message.hpp"
#include "gcode/values/parameters.hpp"
#include "gcode/words/common_meaning.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

constexpr std::int64_t kLargestLine = std::numeric_limits<int>::max();  // an Error can hold

/// The options with the dialect that the program's text shows, of which a note is made.
ReaderOptions with_dialect(ReaderOptions options, const ProgramText& program, Notes& notes) {
  if (options.dialect != Dialect::kAuto) {
    return options;
  }
  options.dialect = Dialect::kLinuxCnc;
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

/// What a program may ask the control for: state of the machine, and of the flow.
class ProgramParameters final : public ParameterSource {
 public:
  ProgramParameters(MachineParameters& machine, const Flow& flow)
      : machine_(machine), flow_(flow) {}

  std::optional<double> numbered(int number) const override { return machine_.numbered(number); }
  std::optional<double> named(std::string_view name) const override {
    if (name == "_line") {
      return static_cast<double>(flow_.line());
    }
    if (name == "_call_level") {
      return static_cast<double>(flow_.call_level());
    }
    return machine_.named(name);
  }
  bool set(int number, double value) override { return machine_.set(number, value); }

 private:
  MachineParameters& machine_;
  const Flow& flow_;
};

}  // namespace

/// All that a reading holds; it stays where it is when its Reader is moved.
class Reader::Reading {
 public:
  Reading(const ProgramText& program, const ReaderOptions& options)
      : options_(with_tools(with_dialect(options, program, notes_), error_)),
        interpreter_(options_, notes_),
        machine_(interpreter_),
        source_(machine_, flow_),
        parameters_(&source_, options_.dialect),
        flow_(program, options_, parameters_, notes_),
        words_(options_.ignored_axes) {}

  Expected<std::optional<Block>> next();
  bool resume();
  const Notes& notes() const noexcept { return notes_; }
  const Flow& flow() const noexcept { return flow_; }

 private:
  Expected<void> read_line();
  Expected<void> execute(std::string_view text);
  Expected<void> execute_subprogram_word();
  void note_what_is_unusual();
  void note_feedrate();
  Expected<void> finish();
  tl::unexpected<Error> stop_with(Error error);

  std::optional<Error> error_;
  Notes notes_;
  ReaderOptions options_;
  Interpreter interpreter_;
  MachineParameters machine_;
  ProgramParameters source_;
  Parameters parameters_;
  Flow flow_;
  LineWords words_;
  LineBlocks blocks_;           // of the line last read
  std::size_t next_block_ = 0;  // place in blocks_ of the next one to give
  bool has_feedrate_ = false;   // an F was read
  bool has_moved_ = false;      // a block other than a dwell was given
  bool has_erred_ = false;      // resume() was called
  bool is_at_end_ = false;
};

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
  return std::optional<Block>(std::move(block));
}

/// Reads one line into blocks_, which is empty if the line does not move.
Expected<void> Reader::Reading::read_line() {
  next_block_ = blocks_.count = 0;
  ExecutedLine line;
  TWIN_TRY(const bool is_line, flow_.next(line));
  if (!is_line) {
    is_at_end_ = true;
    return {};
  }
  Expected<void> done = execute(line.text);
  if (!done && done.error().column > 0) {
    done.error().column += static_cast<int>(line.stepped_over);
  }
  return done;
}

Expected<void> Reader::Reading::execute(std::string_view text) {
  TWIN_CHECK(words_.read(text, parameters_));
  if (parameters_.has_kept()) {
    parameters_.commit();
  }
  if (words_.is_unusual()) {
    note_what_is_unusual();
  }
  if (words_.is_empty()) {
    return {};
  }
  if (words_.has(GGroup::kDwell)) {
    to_common_meaning(words_, options_.dialect, flow_.main_line(), notes_);
  }
  if (words_.has(MGroup::kSubprogram)) {
    return execute_subprogram_word();
  }
  TWIN_CHECK(interpreter_.execute(words_, flow_.main_line(), blocks_));
  is_at_end_ = blocks_.is_end;
  note_feedrate();
  return {};
}

/// Notes an F above what the machine can, and moves that have no F yet.
void Reader::Reading::note_feedrate() {
  if (words_.has('F')) {
    has_feedrate_ = true;
    if (options_.largest_feedrate > 0.0 && !options_.feedrate &&
        interpreter_.state().feedrate > options_.largest_feedrate * (1.0 + 1e-9)) {
      notes_.add(NoteKind::kFeedrate,
                 fmt::format("F is above the machine's {:g} mm/min, which hold",
                             units::mm_per_min_from_mm_per_s(options_.largest_feedrate)),
                 flow_.main_line());
    }
  }
  if (!has_feedrate_ && options_.default_feedrate > 0.0 && !options_.feedrate &&
      blocks_.count > 0 && blocks_.block[blocks_.count - 1].feedrate > 0.0) {
    notes_.add(NoteKind::kFeedrate,
               fmt::format("no F yet: {:g} mm/min of program.default_feedrate hold",
                           units::mm_per_min_from_mm_per_s(options_.default_feedrate)),
               flow_.main_line());
  }
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
    TWIN_CHECK(interpreter_.execute(words_, flow_.main_line(), blocks_));
    is_at_end_ = blocks_.is_end;
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

void Reader::Reading::note_what_is_unusual() {
  const std::int64_t line = flow_.main_line();
  if (words_.oddity() != CommentOddity::kNone) {
    notes_.add(NoteKind::kText,
               words_.oddity() == CommentOddity::kOpen
                   ? "a comment without its ) goes to the end of its line"
                   : "a comment within a comment ends with the outer one",
               line);
  }
  for (const char letter : options_.ignored_axes) {
    if (words_.has_left_out(letter)) {
      notes_.add(NoteKind::kIgnoredAxis, fmt::format("words of axis {} are left out", letter),
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

/// Remembers an error, with file and line if they belong to it, for this call and all that follow.
tl::unexpected<Error> Reader::Reading::stop_with(Error error) {
  if (error.file.empty()) {
    error.file = flow_.file();
  }
  if (error.column > 0 && error.line == 0) {
    error.line = static_cast<int>(std::min(flow_.line(), kLargestLine));
  }
  blocks_.count = next_block_ = 0;
  parameters_.drop();
  error_ = error;
  return tl::unexpected<Error>(std::move(error));
}

/// Forgets the error, so that the line behind it comes next.
bool Reader::Reading::resume() {
  if (!error_ || error_->code != ErrorCode::kProgram || flow_.is_broken() || is_at_end_) {
    return false;
  }
  error_.reset();
  has_erred_ = true;
  return true;
}

Reader::Reader(const ProgramText& program, const ReaderOptions& options)
    : reading_(std::make_unique<Reading>(program, options)) {}
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;
Reader::~Reader() = default;

Expected<Reader> Reader::open(const std::string& path, const ReaderOptions& options) {
  TWIN_TRY(const ProgramText program, ProgramText::read(path));
  return Reader(program, options);
}

Reader Reader::from_text(std::string text, std::string name, const ReaderOptions& options) {
  return Reader(ProgramText::from_text(std::move(text), std::move(name)), options);
}

Expected<std::optional<Block>> Reader::next() { return reading_->next(); }
bool Reader::resume() { return reading_->resume(); }
const Notes& Reader::notes() const noexcept { return reading_->notes(); }
std::int64_t Reader::line() const noexcept { return reading_->flow().furthest_line(); }
std::int64_t Reader::bytes_read() const noexcept { return reading_->flow().bytes_read(); }
std::int64_t Reader::size() const noexcept { return reading_->flow().size(); }

}  // namespace twin::gcode
