#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/error.hpp"
#include "gcode/flow/call_stack.hpp"
#include "gcode/flow/control_index.hpp"
#include "gcode/flow/control_line.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader_options.hpp"
#include "gcode/text/line_source.hpp"
#include "gcode/values/parameters.hpp"

namespace twin::gcode {

class Notes;

/// A line of text for the interpreter.
struct ExecutedLine {
  std::string_view text;         ///< valid until the next call of Flow::next()
  std::size_t stepped_over = 0;  ///< characters of the line in front of it
};

/// Decides which line of a program comes next.
///
///   program text, files of subroutines --LineSource--> lines --control lines--> executed lines
///
/// Lines of flow control (ControlLine) are executed here and never given out; neither are blank
/// lines, deleted blocks and lines with %. Lines that come again, by a loop or a call, are counted,
/// so that a program without end is stopped.
class Flow {
 public:
  static constexpr std::size_t kDeepest = 100;  ///< calls within calls
  static constexpr std::size_t kMostArguments = 30;

  /// @param parameters, notes  must outlive this object
  Flow(const ProgramText& program, const ReaderOptions& options, Parameters& parameters,
       Notes& notes);

  /// Finds the next line to execute. @returns false at the end of the program
  Expected<bool> next(ExecutedLine& executed);

  /// M98: goes to the subprogram of a number, which runs `times` times.
  Expected<void> call_numbered(double number, const std::optional<double>& times, int column);
  /// G65: the same with arguments, #1 to #33 of the macro, each null where it is not given.
  using MacroArguments = std::array<double, Parameters::kMacroLocal>;
  Expected<void> call_macro(double number, const std::optional<double>& times,
                            const MacroArguments& arguments, int column);
  /// M99: back to the caller, or to its line N. @returns false in the main program, which ends
  Expected<bool> return_from_numbered(const std::optional<double>& to_line, int column);

  /// Subroutines that run within each other.
  std::size_t call_level() const noexcept { return frames_.size() - 1; }
  /// What tells the call that runs from all others; 0: the main program.
  std::uint64_t call() const noexcept { return frame_->serial; }
  /// Whether a call has not returned yet.
  bool is_running(std::uint64_t call) const noexcept {
    return std::any_of(frames_.begin(), frames_.end(),
                       [call](const Frame& frame) { return frame.serial == call; });
  }
  /// True if the text cannot be read on behind the last error.
  bool is_broken() const noexcept { return is_broken_; }
  std::int64_t line() const noexcept { return unit().source.line(); }  ///< in its own text
  const std::string& file() const noexcept { return unit().name; }     ///< of that text
  /// Line of the main program: that of the call where a subroutine of another file runs.
  std::int64_t main_line() const noexcept {
    return frames_.size() == 1 ? line() : line_of_main_program();
  }
  std::int64_t furthest_line() const noexcept { return units_.front()->furthest; }
  std::int64_t bytes_read() const noexcept { return units_.front()->source.bytes_read(); }
  std::int64_t size() const noexcept { return units_.front()->source.size(); }
  bool has_words() const noexcept { return frames_.front().has_words; }

 private:
  /// A text: the program, or the file of a subroutine.
  struct Unit {
    explicit Unit(const ProgramText& program)
        : text(program), source(program), name(program.file().string()) {}
    ProgramText text;
    LineSource source;
    std::string name;
    std::optional<ControlIndex> index{};
    std::int64_t furthest = 0;  // line
    bool has_percent = false;
  };
  /// A subroutine: a text and the place of its entry.
  struct Target {
    std::size_t unit;
    std::size_t entry;
  };

  Unit& unit() noexcept { return *unit_; }
  const Unit& unit() const noexcept { return *unit_; }
  Expected<const ControlIndex*> index_of(Unit& of);
  std::int64_t line_of_main_program() const noexcept;
  void take_last_frame() noexcept {
    frame_ = &frames_.back();
    unit_ = units_[frame_->unit].get();
  }
  Expected<void> count_repeated_line();
  Expected<bool> ends_at_percent(std::string_view text, std::size_t at);
  bool is_only_blank_behind();
  Error end_text() const;

  /// Executes a line of flow control. @returns what of it is left to execute, mostly nothing
  Expected<ExecutedLine> control(std::string_view text, std::size_t at, std::int64_t offset);
  Expected<void> o_word(std::string_view text, const ControlLine& control, std::int64_t offset);
  Expected<ExecutedLine> macro_if(std::string_view text, const ControlLine& control);
  Expected<void> macro_loop(std::string_view text, const ControlLine& control, std::int64_t offset);
  Expected<void> begin_name(const ControlLine& control);
  Expected<void> take_next_branch(const ControlLine& control, const ControlIndex& index,
                                  std::size_t entry);
  Expected<LineSource::Place> find_line(std::int64_t number, int column);
  Expected<void> branch(std::string_view text, const ControlLine& control,
                        const ControlIndex& index, std::size_t entry);
  Expected<void> loop(std::string_view text, const ControlLine& control, const ControlIndex& index,
                      std::size_t entry);
  Expected<void> leave_loop(const ControlLine& control, const ControlIndex& index,
                            std::size_t entry);
  Expected<void> call(std::string_view text, const ControlLine& control);
  Expected<void> end_sub(std::string_view text, const ControlLine& control);
  Expected<Target> find_sub(const std::string& label, int column);
  Expected<std::optional<std::size_t>> include(const std::string& label);
  Expected<bool> condition(std::string_view text, std::size_t at);
  Expected<void> go_to_line(double number, int column);
  Expected<Frame> numbered_frame(double number, const std::optional<double>& times, int column);
  Expected<void> push(Frame frame, int column);
  void pop();

  const ReaderOptions options_;
  Parameters& parameters_;
  Notes& notes_;
  std::vector<std::unique_ptr<Unit>> units_;
  std::map<std::string, std::size_t, std::less<>> files_;  // label -> unit
  std::vector<Frame> frames_;
  Frame* frame_;  // the last of frames_
  Unit* unit_;    // its text
  /// Places that GOTO has found: unit, place of the GOTO, N.
  std::map<std::tuple<std::size_t, std::int64_t, std::int64_t>, LineSource::Place> gotos_;
  std::int64_t repeated_ = 0;  // lines that came again
  std::uint64_t calls_ = 0;    // begun so far
  bool is_broken_ = false;
};

}  // namespace twin::gcode
