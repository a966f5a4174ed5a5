#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "gcode/interpreter/arc_words.hpp"
#include "gcode/interpreter/cutter_compensation.hpp"
#include "gcode/interpreter/cycle_words.hpp"
#include "gcode/interpreter/drilling_cycle.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "gcode/interpreter/nurbs_collector.hpp"
#include "gcode/interpreter/set_up.hpp"
#include "gcode/interpreter/threading_cycle.hpp"
#include "gcode/reader_options.hpp"

namespace twin::gcode {

class LineWords;
class Notes;

/// Blocks of one line: at most tool change, dwell, two moves and stop, in this order, or some of the
/// many of a canned cycle. Whoever takes a block moves it out, so that `nurbs` is null in all of
/// them before the next line.
struct LineBlocks {
  std::array<Block, 6> block;
  std::size_t count = 0;
  bool is_end = false;  ///< M02 or M30: nothing after this line is part of the program
};

/// What M70 keeps: the modal state, the work offset in force and the tool's offset.
struct SavedState {
  ModalState state;
  std::size_t work_offset = 0;
  Vec3 tool_offset = Vec3::Zero();  ///< [mm]
};

/// Where a probing move has ended, in the coordinates and units of the program.
struct Probed {
  Vec3 place = Vec3::Zero();
  bool is_skip = false;  ///< by G31
};

/// Turns the words of line after line into blocks; holds the modal state and the position.
///
/// Within a line the order of words does not matter; what it asks for is done in the order of
/// RS274: modal words, M06, G04, G40 to G42, G43 G49, G54, G10 G28 G52 G92, the move, M00 M01 M02
/// M30. Moves are followed in machine coordinates:
///   words -> place in the program (target) -> place on the machine (Coordinates) -> block
///         -> beside the contour (CutterCompensation)
class Interpreter {
 public:
  /// @param notes  takes what does not stop the program; must outlive this object
  Interpreter(const ReaderOptions& options, Notes& notes);

  /// Executes a line.
  ///
  /// @param words   words of the line
  /// @param line    its number, from 1
  /// @param blocks  filled with its blocks, or the first of them
  Expected<void> execute(const LineWords& words, std::int64_t line, LineBlocks& blocks);

  /// Whether the line last executed has further blocks, which more() gives.
  bool has_more() const noexcept {
    return !cycle_.is_done() || !threading_.is_done() || next_waiting_ < waiting_.size() ||
           has_pending_stop_;
  }
  /// Replaces the blocks by the next ones of the line.
  void more(LineBlocks& blocks);

  /// Ends the program. The last blocks of a cutter compensation come by more() then.
  /// @returns an error if a NURBS is still open
  Expected<void> finish() { return finish_at(1); }

  /// The state for M70 and M73. @returns an error with the cutter compensation on
  Expected<SavedState> saved_state(int column) const;
  /// Puts a state in force again, but for the motion word, as M72 does.
  void restore(const SavedState& saved);

  /// Goes on behind a line that execute() has refused, or that could not be read, so that its error
  /// is no reason for others.
  ///
  /// @param is_whole  whether the line's words say where it leads
  void recover(const LineWords& words, bool is_whole);

  /// Where the probing move of the line last executed has ended, if it had one; told once.
  bool has_probed() const noexcept { return probed_.has_value(); }
  std::optional<Probed> take_probed() { return std::exchange(probed_, std::nullopt); }

  const ModalState& state() const noexcept { return state_; }
  /// Where the words have led, in the coordinates of the program [mm].
  const Vec3& position() const noexcept { return programmed_; }
  SetUp& set_up() noexcept { return set_up_; }
  const SetUp& set_up() const noexcept { return set_up_; }

 private:
  bool is_plain_move(const LineWords& words) const noexcept;
  void execute_plain_move(const LineWords& words, LineBlocks& blocks);
  Expected<void> prepare(const LineWords& words, Plane plane_before, LineBlocks& blocks);
  void note_words_without_effect(const LineWords& words);
  Expected<void> change_compensation(const LineWords& words);
  Expected<void> add_moves(const LineWords& words, LineBlocks& blocks);
  Expected<void> add_move(const LineWords& words, LineBlocks& blocks);
  Expected<void> add_home(const LineWords& words, LineBlocks& blocks);
  Expected<void> add_spline(const LineWords& words, LineBlocks& blocks);
  Expected<void> start_cycle(const LineWords& words);
  Expected<void> check_place(const LineWords& words) const;
  Expected<void> check_probing(const LineWords& words);
  void keep_probed();
  Expected<void> add_threading(const LineWords& words, LineBlocks& blocks);
  Expected<void> shape_arc(const LineWords& words, const Vec3& from, Block& block);
  Expected<ProgrammedArc> arc_of_words(const LineWords& words, const Vec3& from,
                                       const ArcEnds& ends);
  Expected<void> shape_turns(const LineWords& words, geometry::Arc& arc) const;
  Expected<Vec3> target(const LineWords& words);
  Vec3 polar_target(const LineWords& words, const Vec3& place) const;
  Vec3 machine_target(const LineWords& words) const;

  bool concerns_nurbs(const LineWords& words) const noexcept;
  bool is_of_broken_nurbs(const LineWords& words) noexcept;
  Expected<void> execute_nurbs(const LineWords& words, MotionMode before, LineBlocks& blocks);
  Expected<void> end_nurbs(const LineWords& words, MotionMode before, LineBlocks& blocks);
  Expected<void> add_nurbs(int column, LineBlocks& blocks);
  void add_curve(std::shared_ptr<const ProgrammedCurve> curve, const Vec3& end, std::int64_t line,
                 LineBlocks& blocks);

  Expected<void> finish_at(int column);
  Block& next_block(LineBlocks& blocks, Motion motion) const;
  void keep(LineBlocks& blocks);
  void add_rest(double duration, LineBlocks& blocks);
  void add_straight(Motion motion, const Vec3& end, double feedrate, LineBlocks& blocks);
  Expected<void> compensate(int column, LineBlocks& blocks);
  void fill(LineBlocks& blocks);
  const Coordinates& coordinates() const noexcept { return set_up_.coordinates(); }

  ModalState state_;
  SetUp set_up_;
  Vec3 position_;    // end of the last block, on the machine [mm]
  Vec3 programmed_;  // where the words have led, in the program's coordinates [mm]
  std::optional<double> feedrate_;
  Notes* notes_;
  std::int64_t line_ = 0;
  bool stops_once_ = false;  // G09 on this line
  NurbsCollector nurbs_;
  CycleWords cycle_words_;
  DrillingCycle cycle_;       // of this line
  ThreadingCycle threading_;  // of this line
  bool may_probe_;
  std::optional<Probed> probed_;
  bool has_pending_stop_ = false;
  CutterCompensation compensation_;
  bool must_leave_straight_ = false;  // behind G40
  std::vector<Block> waiting_;        // compensated, to be given
  std::size_t next_waiting_ = 0;
  Vec2 spline_direction_ = Vec2::Zero();  // into the end of the last G05 [mm]
  std::optional<Vec3> spline_end_;        // [mm]
  bool is_nurbs_broken_ = false;          // its other lines are left out
  bool is_lost_ = false;                  // behind an error: where the tool is, is not known
};

}  // namespace twin::gcode
