#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "gcode/flow/flow.hpp"
#include "gcode/interpreter/interpreter.hpp"
#include "gcode/interpreter/machine_parameters.hpp"
#include "gcode/notes.hpp"
#include "gcode/reader.hpp"
#include "gcode/values/parameters.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {

/// What a program may ask the control for: state of the machine, and of the flow.
class ProgramParameters final : public ParameterSource {
 public:
  /// @param machine, flow  must outlive this object
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

/// All that a reading holds; it stays where it is when its Reader is moved.
class Reader::Reading {
 public:
  static constexpr int kMostResumed = 10000;  ///< errors behind which a reading goes on

  Reading(const ProgramText& program, const ReaderOptions& options);

  Expected<std::optional<Block>> next();
  bool resume();
  const Notes& notes() const noexcept { return notes_; }
  const Flow& flow() const noexcept { return flow_; }

 private:
  /// What G65 or G66 calls.
  struct ModalMacro {
    double number = 0.0;
    std::optional<double> times{};
    Flow::MacroArguments arguments{};
    int column = 0;
    std::uint64_t call = 0;  // in which G66 stands; macros do not call themselves
  };
  /// The modal state that M70 or M73 has kept for a call.
  struct KeptState {
    std::uint64_t call = 0;
    bool is_for_return = false;
    bool is_valid = true;
    SavedState state{};
  };

  Expected<void> read_line();
  Expected<void> execute(std::string_view text);
  Expected<void> execute_system_command(std::string_view text);
  Expected<void> execute_seldom_words();
  Expected<void> execute_subprogram_word();
  Expected<void> execute_macro_word();
  Expected<void> call_macro(const ModalMacro& macro);
  Expected<void> execute_rest();
  Expected<void> execute_state_word();
  void leave_ended_calls();
  void recover();
  void note_what_is_unusual();
  void note_feedrate();
  void keep_probed();
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
  std::string_view text_;       // of that line, without what was stepped over; empty: none
  bool has_moved_ = false;      // a block other than a dwell was given
  bool has_erred_ = false;      // resume() was called
  bool is_at_end_ = false;
  std::optional<ModalMacro> modal_macro_;  // of G66
  std::vector<KeptState> states_;          // of M70 and M73, by the calls that run
  int resumed_ = 0;                        // times
};

}  // namespace twin::gcode
