#include "gcode/interpreter/interpreter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "gcode/interpreter/line_check.hpp"
#include "gcode/notes.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

constexpr std::uint32_t kPrepared = LineWords::groups_of(
    GGroup::kDwell, GGroup::kPlane, GGroup::kCutterCompensation, GGroup::kToolLength,
    GGroup::kWorkOffset, GGroup::kSetting, GGroup::kScaling, GGroup::kMirror, GGroup::kRotation,
    GGroup::kPathMode, GGroup::kSpindleMode, GGroup::kSmoothness, GGroup::kDiameter,
    GGroup::kMotion);

constexpr std::uint32_t kOfPlainMove = LineWords::set_of("FNXYZ");
constexpr std::uint32_t kMotionAlone = LineWords::groups_of(GGroup::kMotion);

bool goes_home(const LineWords& words) {
  return words.has(GGroup::kSetting, GWord::kHome) ||
         words.has(GGroup::kSetting, GWord::kSecondHome);
}

}  // namespace

Interpreter::Interpreter(const ReaderOptions& options, Notes& notes)
    : set_up_(options),
      position_(options.start),
      programmed_(set_up_.coordinates().program_of(options.start)),
      feedrate_(options.feedrate),
      notes_(&notes),
      may_probe_(options.may_probe) {
  state_.feedrate = state_.default_feedrate = options.default_feedrate;
  state_.is_fanuc = options.dialect == Dialect::kFanuc;
  if (options.dialect == Dialect::kGrbl || state_.is_fanuc) {
    state_.motion = MotionMode::kRapid;
    state_.behind_cycle = state_.is_fanuc ? MotionMode::kRapid : MotionMode::kNone;
  }
  state_.may_guess_centres = options.guesses_centres;
}

Expected<void> Interpreter::execute(const LineWords& words, std::int64_t line, LineBlocks& blocks) {
  blocks.count = 0;
  line_ = line;
  if (is_plain_move(words)) {
    blocks.is_end = false;
    execute_plain_move(words, blocks);
    return {};
  }
  blocks.is_end = words.has(MGroup::kStop, MWord::kEnd);
  if (is_nurbs_broken_ && is_of_broken_nurbs(words)) {
    return {};
  }
  const MotionMode before = state_.motion;
  const Plane plane_before = state_.plane;
  update(state_, words, feedrate_);
  if ((nurbs_.is_open() || state_.is_nurbs() || words.has(GGroup::kMotion)) &&
      concerns_nurbs(words)) {
    return execute_nurbs(words, before, blocks);
  }
  TWIN_CHECK(check_words(words, state_, feedrate_.has_value(), *notes_, line));
  if ((words.g_groups() & kPrepared) != 0 || words.has_m() || words.has('T')) {
    TWIN_CHECK(prepare(words, plane_before, blocks));
  }
  stops_once_ = words.has(GGroup::kOnce);
  if (words.has_any("XYZIJKR") || (words.g_groups() & kPrepared) != 0) {
    TWIN_CHECK(add_moves(words, blocks));
  }
  state_.leave_skip(before);
  has_pending_stop_ = words.has(MGroup::kStop, MWord::kStop);
  if (blocks.is_end) {
    TWIN_CHECK(finish_at(words.column(MGroup::kStop)));
  }
  if (has_more()) {
    fill(blocks);
  }
  return {};
}

/// Whether nothing but a straight move is on a line, and nothing in force makes it another: most
/// lines of most programs, which need none of the checks.
bool Interpreter::is_plain_move(const LineWords& words) const noexcept {
  if ((words.letters() & ~kOfPlainMove) != 0 || (words.g_groups() & ~kMotionAlone) != 0 ||
      words.has_m()) {
    return false;
  }
  MotionMode motion = state_.motion;
  if (words.has(GGroup::kMotion)) {
    const GWord word = words.g(GGroup::kMotion);
    motion = word == GWord::kRapid    ? MotionMode::kRapid
             : word == GWord::kLinear ? MotionMode::kLinear
                                      : MotionMode::kNone;
  }
  const bool has_feed = words.has('F') ? words.value('F') > 0.0 : state_.feedrate > 0.0;
  return (motion == MotionMode::kRapid || (motion == MotionMode::kLinear && has_feed)) &&
         state_.feed_mode == FeedMode::kPerMinute && !state_.is_nurbs() && !state_.is_polar &&
         !compensation_.is_on() && !nurbs_.is_open() && !is_nurbs_broken_ && !is_lost_ &&
         set_up_.axes_to_name() == 0;
}

void Interpreter::execute_plain_move(const LineWords& words, LineBlocks& blocks) {
  stops_once_ = false;
  if (words.g_groups() != 0 || words.has('F')) {
    update(state_, words, feedrate_);
    if (words.g_groups() != 0) {
      cycle_words_.cancel();
    }
  }
  if (!words.has_any("XYZ")) {
    return;
  }
  const double unit = state_.unit;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char letter = "XYZ"[axis];
    if (words.has(letter)) {
      const double number = words.value(letter) * unit;
      programmed_[axis] = state_.is_incremental ? programmed_[axis] + number : number;
    }
  }
  add_straight(state_.motion == MotionMode::kRapid ? Motion::kRapid : Motion::kLinear,
               coordinates().machine_of(programmed_), state_.feedrate, blocks);
  if (blocks.count > 0) {
    must_leave_straight_ = false;
  }
}

/// What a line does before it moves.
Expected<void> Interpreter::prepare(const LineWords& words, Plane plane_before,
                                    LineBlocks& blocks) {
  if (compensation_.is_on() && (state_.plane != plane_before || words.has(MGroup::kToolChange))) {
    return fail_at(words.has(GGroup::kPlane) ? words.column(GGroup::kPlane)
                                             : words.column(MGroup::kToolChange),
                   "another plane or tool with the cutter compensation on: expected G40 before it");
  }
  TWIN_CHECK(set_up_.change_tool(words));
  if (words.has(MGroup::kToolChange, MWord::kToolChange)) {
    add_rest(0.0, blocks);
  }
  if (words.has(GGroup::kDwell)) {
    add_rest(words.value('P'), blocks);
  }
  note_words_without_effect(words);
  if (words.has(GGroup::kCutterCompensation)) {
    TWIN_CHECK(change_compensation(words));
  }
  if (words.has(GGroup::kMotion) && state_.motion != MotionMode::kCycle) {
    cycle_words_.cancel();
  }
  if (!SetUp::concerns(words)) {
    return {};
  }
  const std::uint64_t version = coordinates().version();
  TWIN_CHECK(set_up_.apply(words, state_, programmed_, *notes_, line_));
  if (compensation_.is_on() && (coordinates().version() != version || goes_home(words))) {
    return fail_at(words.first_g_column(),
                   "a change of coordinates or a return to home with the cutter compensation on: "
                   "expected G40 before it");
  }
  return {};
}

Expected<void> Interpreter::change_compensation(const LineWords& words) {
  const int column = words.column(GGroup::kCutterCompensation);
  if (words.g(GGroup::kCutterCompensation) == GWord::kNoCutterCompensation) {
    must_leave_straight_ = must_leave_straight_ || compensation_.is_on();
    return finish_at(column);
  }
  if (compensation_.is_on()) {
    return fail_at(column, "the cutter compensation is on already: expected G40 before G41 or G42");
  }
  if (state_.plane == Plane::kYz) {
    return fail_at(column, "cutter compensation in the plane of G19: expected G17 or G18");
  }
  if (!coordinates().is_shift_only() && state_.plane != Plane::kXy) {
    return fail_at(column, "cutter compensation in turned coordinates: expected G17");
  }
  TWIN_TRY(double radius, set_up_.cutter_radius(words, state_, *notes_, line_));
  radius = coordinates().is_mirrored() ? -radius : radius;
  compensation_.start(radius, state_.plane);
  return {};
}

Expected<void> Interpreter::add_moves(const LineWords& words, LineBlocks& blocks) {
  if (goes_home(words)) {
    return add_home(words, blocks);
  }
  if (!asks_for_move(words, state_)) {
    return check_place(words);
  }
  if (draws_spline(words)) {
    return add_spline(words, blocks);
  }
  if (words.has(GGroup::kMachineCoordinates)) {
    if (state_.is_incremental || compensation_.is_on() ||
        (state_.motion != MotionMode::kRapid && state_.motion != MotionMode::kLinear)) {
      return fail_at(words.column(GGroup::kMachineCoordinates),
                     "G53 moves in machine coordinates: expected G00 or G01, G90 and G40");
    }
  }
  if (state_.motion == MotionMode::kCycle) {
    return start_cycle(words);
  }
  if (state_.is_threading()) {
    return add_threading(words, blocks);
  }
  if (!state_.is_probing()) {
    return add_move(words, blocks);
  }
  TWIN_CHECK(check_probing(words));
  TWIN_CHECK(add_move(words, blocks));
  keep_probed();
  return {};
}

/// Whether a line without X, Y and Z has no word that needs them.
Expected<void> Interpreter::check_place(const LineWords& words) const {
  if (words.has(GGroup::kSetting)) {
    return {};
  }
  const bool has_motion = words.has(GGroup::kMotion);
  if (state_.motion == MotionMode::kCycle && (words.has_any("RLK") || has_motion)) {
    return fail_at(has_motion ? words.column(GGroup::kMotion) : words.first_column("RLK"),
                   "a canned cycle without a place: expected X, Y or Z on its line");
  }
  if (has_motion && (state_.is_probing() || state_.is_threading())) {
    return fail_at(words.column(GGroup::kMotion),
                   fmt::format("G{:g} leads nowhere: expected X, Y or Z on its line",
                               words.g_number(GGroup::kMotion)));
  }
  return {};
}

Expected<void> Interpreter::start_cycle(const LineWords& words) {
  if (compensation_.is_on() || state_.feed_mode == FeedMode::kInverseTime) {
    return fail_at(words.first_g_column(),
                   "a canned cycle with cutter compensation or G93 in force: expected G40 and G94");
  }
  TWIN_TRY(const Vec3 hole, target(words));
  TWIN_TRY(const CycleLine line, cycle_words_.read(words, state_, programmed_, hole));
  if (line.kind == CycleKind::kTap) {
    notes_->add(NoteKind::kWithoutEffect,
                "G74 and G84 move as programmed; the spindle is not modelled", line_);
  }
  must_leave_straight_ = false;
  cycle_ = DrillingCycle(line, programmed_);
  return {};
}

/// Fills up with blocks of the line that are still to come.
void Interpreter::fill(LineBlocks& blocks) {
  while (next_waiting_ < waiting_.size() && blocks.count < blocks.block.size()) {
    blocks.block[blocks.count++] = std::move(waiting_[next_waiting_++]);
  }
  while (!cycle_.is_done() && blocks.count < blocks.block.size()) {
    const auto move = cycle_.next();
    if (!move) {
      break;
    }
    if (move->kind == CycleMove::Kind::kRest) {
      add_rest(move->rest, blocks);
    } else {
      programmed_ = move->place;
      add_straight(move->kind == CycleMove::Kind::kRapid ? Motion::kRapid : Motion::kLinear,
                   coordinates().machine_of(programmed_), state_.feedrate, blocks);
    }
  }
  while (!threading_.is_done() && blocks.count < blocks.block.size()) {
    if (const auto move = threading_.next()) {
      programmed_ = move->place;
      add_straight(move->feedrate > 0.0 ? Motion::kLinear : Motion::kRapid,
                   coordinates().machine_of(programmed_), move->feedrate, blocks);
    }
  }
  const bool is_rest_done =
      cycle_.is_done() && threading_.is_done() && next_waiting_ == waiting_.size();
  if (has_pending_stop_ && is_rest_done && blocks.count < blocks.block.size()) {
    has_pending_stop_ = false;
    add_rest(0.0, blocks);
  }
}

void Interpreter::more(LineBlocks& blocks) {
  blocks.count = 0;
  fill(blocks);
}

Block& Interpreter::next_block(LineBlocks& blocks, Motion motion) const {
  Block& block = blocks.block[blocks.count];
  block.motion = motion;
  block.path_mode = stops_once_ ? PathMode::kExactStop : state_.path_mode;
  block.start = block.end = position_;
  block.feedrate = 0.0;
  block.tolerance = state_.tolerance;
  block.dwell = 0.0;
  block.program_zero = coordinates().height_of_origin();
  block.line = line_;
  block.tool = set_up_.tool();
  block.work_offset = static_cast<std::int16_t>(coordinates().selected());
  return block;
}

/// Adds the next block, behind those that wait.
void Interpreter::keep(LineBlocks& blocks) {
  if (next_waiting_ < waiting_.size()) {
    waiting_.push_back(std::move(blocks.block[blocks.count]));
  } else {
    ++blocks.count;
  }
}

void Interpreter::add_rest(double duration, LineBlocks& blocks) {
  next_block(blocks, Motion::kDwell).dwell = duration;
  if (compensation_.is_on()) {
    // A rest has no length: it cannot fail but by their number, which the next move tells.
    static_cast<void>(compensate(1, blocks));
  } else {
    keep(blocks);
  }
}

/// A rapid or a feed move along a line to a place on the machine; none if it has no length.
void Interpreter::add_straight(Motion motion, const Vec3& end, double feedrate,
                               LineBlocks& blocks) {
  Block& block = next_block(blocks, motion);
  block.end = end;
  block.feedrate = motion == Motion::kRapid ? 0.0 : feedrate;
  if ((block.end - block.start).squaredNorm() >= kNoLength * kNoLength) {
    keep(blocks);
    position_ = end;
  }
}

/// Gives the next block to the cutter compensation.
Expected<void> Interpreter::compensate(int column, LineBlocks& blocks) {
  Block& block = blocks.block[blocks.count];
  if (auto added = compensation_.add(block, state_.feedrate); !added) {
    added.error().column = column;
    return added;
  }
  if (next_waiting_ == waiting_.size()) {
    waiting_.clear();
    next_waiting_ = 0;
  }
  compensation_.take_ready(waiting_);
  return {};
}

Expected<void> Interpreter::finish_at(int column) {
  if (nurbs_.is_open()) {
    return tl::unexpected<Error>(nurbs_.cut_short("the program ends"));
  }
  if (compensation_.is_on()) {
    auto end = compensation_.finish(position_);
    if (!end) {
      end.error().column = column;
      return tl::unexpected<Error>(std::move(end.error()));
    }
    position_ = *end;
    compensation_.take_ready(waiting_);
  }
  return {};
}

}  // namespace twin::gcode
