#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "gcode/interpreter/arc_words.hpp"
#include "gcode/interpreter/interpreter.hpp"
#include "gcode/interpreter/plane.hpp"
#include "gcode/notes.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

// The moves of a line: G00 to G03, G53, G28 and G30, G05 and G05.1.

namespace twin::gcode {
namespace {

constexpr double kMostTurns = 10000.0;
constexpr double kNotableChange = 0.02;  // of the radius of an arc [mm]

/// How far start and end radius of an arc may differ: what LinuxCNC 2.9 takes, which is more in
/// inches.
double slack_of(double unit) {
  constexpr double kSlack = 0.02 * std::numbers::sqrt2;         // [mm]
  constexpr double kSlackInches = 0.002 * std::numbers::sqrt2;  // [inch]
  return unit == 1.0 ? kSlack : kSlackInches * unit;
}

double length_of(const Block& block) {
  return block.motion == Motion::kArc ? geometry::length_to(block.arc, 1.0)
                                      : (block.end - block.start).norm();
}

}  // namespace

Expected<void> Interpreter::add_move(const LineWords& words, LineBlocks& blocks) {
  const Vec3 from = programmed_;
  Block& block = next_block(blocks, Motion::kLinear);
  if (words.has(GGroup::kMachineCoordinates)) {
    block.end = machine_target(words);
    programmed_ = coordinates().program_of(block.end);
  } else {
    TWIN_TRY(programmed_, target(words));
    block.end = coordinates().machine_of(programmed_);
  }
  if (state_.is_arc()) {
    if (must_leave_straight_) {
      return fail_at(words.first_column("XYZIJKR"),
                     "an arc behind G40: expected a straight move out of the cutter compensation");
    }
    block.motion = Motion::kArc;
    block.feedrate = state_.feedrate;
    if (auto shaped = shape_arc(words, from, block); !shaped && is_lost_) {
      block.motion = Motion::kLinear;
    } else {
      TWIN_CHECK(shaped);
    }
  } else {
    const bool is_rapid = state_.motion == MotionMode::kRapid;
    block.motion = is_rapid ? Motion::kRapid : Motion::kLinear;
    block.feedrate = is_rapid ? 0.0 : state_.feedrate;
    if ((block.end - block.start).squaredNorm() < kNoLength * kNoLength) {
      return {};
    }
    must_leave_straight_ = false;
  }
  if (state_.feed_mode == FeedMode::kInverseTime && !feedrate_) {
    block.feedrate *= length_of(block);
  }
  is_lost_ = is_lost_ && (state_.is_incremental || !words.has('X') || !words.has('Y'));
  position_ = block.end;
  if (compensation_.is_on()) {
    return compensate(words.first_column("XYZIJKR"), blocks);
  }
  keep(blocks);
  return {};
}

/// The arc of a line by R, or by I J K. Where nothing has said how these are meant, the first arc
/// whose end fits one meaning alone decides.
Expected<ProgrammedArc> Interpreter::arc_of_words(const LineWords& words, const Vec3& from,
                                                  const ArcEnds& ends) {
  if (words.has('R')) {
    return arc_by_radius(ends, words.value('R') * state_.unit);
  }
  const double slack = slack_of(state_.unit);
  const Vec3 centre =
      Vec3(words.value_or_zero('I'), words.value_or_zero('J'), words.value_or_zero('K')) *
      state_.unit;
  auto arc = arc_by_offset(ends, state_.has_absolute_centres ? Vec3(centre - from) : centre, slack);
  if (!state_.may_guess_centres) {
    return arc;
  }
  if (arc) {
    state_.may_guess_centres = from == Vec3::Zero();  // else it is known: from the start
    return arc;
  }
  auto other = arc_by_offset(ends, centre - from, slack);
  if (!other) {
    return arc;
  }
  state_.has_absolute_centres = true;
  state_.may_guess_centres = false;
  notes_->add(NoteKind::kDialect,
              "I, J and K are absolute (G90.1), as the first arc fits no other way", line_);
  return other;
}

Expected<void> Interpreter::shape_arc(const LineWords& words, const Vec3& from, Block& block) {
  const Coordinates& frame = coordinates();
  const bool is_shift_only = frame.is_shift_only();
  ArcEnds ends{block.start, block.end, state_.plane, state_.motion == MotionMode::kArcClockwise};
  if (!is_shift_only) {
    ends.start = from;
    ends.end = programmed_;
  }
  auto arc = arc_of_words(words, from, ends);
  if (!arc) {
    arc.error().column = words.first_column("IJKR");
    return tl::unexpected<Error>(std::move(arc.error()));
  }
  if (words.has('P')) {
    TWIN_CHECK(shape_turns(words, arc->geometry));
  }
  if (std::abs(arc->geometry.radius_change) > kNotableChange) {
    notes_->add(NoteKind::kGeometry, "an arc whose end lies off its circle is followed as a spiral",
                line_);
  }
  block.arc = is_shift_only ? arc->geometry : frame.machine_arc(arc->geometry);
  block.end = is_shift_only ? arc->end : frame.machine_of(arc->end);
  return {};
}

/// P of an arc: that many turns are begun.
Expected<void> Interpreter::shape_turns(const LineWords& words, geometry::Arc& arc) const {
  const double turns = words.value('P');
  if (!(turns >= 1.0 && turns <= kMostTurns) || turns != std::floor(turns)) {
    return fail_at(words.column('P'),
                   fmt::format("P{:.10g} of an arc: expected a number of turns, whole, from 1 to "
                               "{:.0f}",
                               turns, kMostTurns));
  }
  arc.sweep += (turns - 1.0) * 2.0 * std::numbers::pi;
  return {};
}

Expected<Vec3> Interpreter::target(const LineWords& words) {
  Vec3 place = programmed_;
  std::uint32_t named = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char letter = "XYZ"[axis];
    if (words.has(letter)) {
      const double number = words.value(letter) * state_.unit;
      place[axis] = state_.is_incremental ? programmed_[axis] + number : number;
      named |= 1U << static_cast<unsigned>(axis);
    }
  }
  if (const std::uint32_t needed = set_up_.axes_to_name(); needed != 0 && !state_.is_incremental) {
    if ((needed & ~named) != 0) {
      return fail_at(words.first_column("XYZIJKR"),
                     "the first move behind G68, G69, G51.1 or G50.1 must name every axis that "
                     "these turn: controls do not agree on the coordinate of one left out");
    }
    set_up_.axes_named(named);
  }
  if (state_.is_polar) {
    if (state_.is_incremental) {
      return fail_at(words.first_column("XYZIJKR"),
                     "G16 (polar coordinates) with G91: expected G90, radius and angle from the "
                     "origin");
    }
    return polar_target(words, place);
  }
  return place;
}

/// With G16 the first axis of the plane is the radius from the origin, the second the angle in
/// degrees; what is left out keeps the value that the place before has.
Vec3 Interpreter::polar_target(const LineWords& words, const Vec3& place) const {
  const PlaneAxes axes = axes_of(state_.plane);
  const char radius_letter = "XYZ"[axes.first];
  const char angle_letter = "XYZ"[axes.second];
  if (!words.has(radius_letter) && !words.has(angle_letter)) {
    return place;
  }
  const Vec2 before = in_plane(programmed_, axes);
  const double radius = words.has(radius_letter) ? place[axes.first] : before.norm();
  const double angle = words.has(angle_letter)
                           ? words.value(angle_letter) * std::numbers::pi / 180.0
                           : std::atan2(before.y(), before.x());
  Vec3 result = place;
  result[axes.first] = radius * std::cos(angle);
  result[axes.second] = radius * std::sin(angle);
  return result;
}

/// G53: the axes that are named go to machine coordinates.
Vec3 Interpreter::machine_target(const LineWords& words) const {
  Vec3 place = position_;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char letter = "XYZ"[axis];
    if (words.has(letter)) {
      place[axis] = words.value(letter) * state_.unit;
    }
  }
  return place;
}

/// G28 and G30: by a place of the program, if one is named, to the home of the axes named, or of
/// all.
Expected<void> Interpreter::add_home(const LineWords& words, LineBlocks& blocks) {
  const bool is_first = words.g(GGroup::kSetting) == GWord::kHome;
  if (words.has('P') && !words.has(GGroup::kDwell) && words.value('P') != 2.0) {
    return fail_at(words.column('P'), "G30 goes to the second home: expected P2, or no P");
  }
  if (!coordinates().is_shift_only() && words.has_any("XYZ") &&
      !(words.has('X') && words.has('Y')) && !(words.has('Z') && !words.has_any("XY"))) {
    return fail_at(
        words.first_column("XYZ"),
        "home of one axis in turned coordinates: controls do not agree which axis moves; "
        "expected X and Y together");
  }
  if (words.has_left_out() && !words.has_any("XYZ")) {
    return {};  // of an axis that is not there
  }
  const Vec3& home = is_first ? set_up_.home() : set_up_.second_home();
  must_leave_straight_ = false;
  Vec3 goal = home;
  if (words.has_any("XYZ")) {
    TWIN_TRY(programmed_, target(words));
    add_straight(Motion::kRapid, coordinates().machine_of(programmed_), 0.0, blocks);
    goal = position_;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      goal[axis] = words.has("XYZ"[axis]) ? home[axis] : goal[axis];
    }
  }
  add_straight(Motion::kRapid, goal, 0.0, blocks);
  programmed_ = coordinates().program_of(goal);
  return {};
}

/// G05, a cubic, and G05.1, a parabola, as Bezier curves in the XY plane:
///   G05:   start, start + (I, J), end + (P, Q), end
///   G05.1: start, start + (I, J), end
/// Source: LinuxCNC, G-Code manual, "G5 Cubic Spline", "G5.1 Quadratic Spline".
Expected<void> Interpreter::add_spline(const LineWords& words, LineBlocks& blocks) {
  const int column = words.column(GGroup::kMotion);
  const bool is_cubic = words.g(GGroup::kMotion) == GWord::kCubicSpline;
  const bool has_centre = words.has('I') && words.has('J');
  if (state_.plane != Plane::kXy || words.has('Z') || compensation_.is_on() || state_.is_polar ||
      must_leave_straight_ || state_.path_mode == PathMode::kExactStop || stops_once_) {
    return fail_at(column, fmt::format("{} draws a curve in the XY plane: expected G17, G40, G64, "
                                       "and no Z word",
                                       is_cubic ? "G05" : "G05.1"));
  }
  if (state_.feed_mode == FeedMode::kInverseTime && !feedrate_) {
    return fail_at(column, "a spline with G93 (inverse time): expected G94");
  }
  if (is_cubic ? !(words.has('P') && words.has('Q')) : !has_centre || words.has('Q')) {
    return fail_at(column, is_cubic ? "G05 has no second control point: expected P and Q"
                                    : "G05.1 has no control point: expected I and J");
  }
  if (is_cubic && words.has('I') != words.has('J')) {
    return fail_at(words.first_column("IJ"), "G05 has I or J alone: expected both, or neither");
  }
  const bool goes_on = spline_end_ && *spline_end_ == position_;
  if (is_cubic && !has_centre && !goes_on) {
    return fail_at(column,
                   "G05 has no first control point: expected I and J, which only a G05 "
                   "right behind another may leave out");
  }
  const auto vector = [&](char x, char y) {
    return Vec3(words.value_or_zero(x) * state_.unit, words.value_or_zero(y) * state_.unit, 0.0);
  };
  const Vec3 start = programmed_;
  TWIN_TRY(const Vec3 end, target(words));
  const Vec3 first =
      has_centre ? vector('I', 'J') : Vec3(spline_direction_.x(), spline_direction_.y(), 0.0);
  std::vector<Vec3> points{start, start + first};
  if (is_cubic) {
    points.push_back(end + vector('P', 'Q'));
  }
  points.push_back(end);
  for (Vec3& point : points) {
    point = coordinates().machine_of(point);
  }
  points.front() = position_;
  const std::size_t order = points.size();
  std::vector<double> knots(order, 0.0);
  knots.insert(knots.end(), order, 1.0);
  auto curve = geometry::Curve::create(static_cast<int>(order) - 1, std::move(knots),
                                       std::move(points), std::vector<double>(order, 1.0));
  if (!curve) {
    return fail_at(column, std::move(curve.error().message));
  }
  auto made = make_programmed_curve(std::move(*curve));
  if (!made) {
    return fail_at(column, std::move(made.error().message));
  }
  programmed_ = end;
  add_curve(std::move(*made), coordinates().machine_of(end), line_, blocks);
  spline_direction_ = is_cubic ? Vec2(-vector('P', 'Q').head<2>()) : Vec2(Vec2::Zero());
  spline_end_ = is_cubic ? std::optional<Vec3>(position_) : std::nullopt;
  return {};
}

void Interpreter::add_curve(std::shared_ptr<const ProgrammedCurve> curve, const Vec3& end,
                            std::int64_t line, LineBlocks& blocks) {
  Block& block = next_block(blocks, Motion::kNurbs);
  block.path_mode = state_.path_mode;
  block.end = position_ = end;
  block.nurbs = std::move(curve);
  block.feedrate = state_.feedrate;
  block.line = line;
  keep(blocks);
}

}  // namespace twin::gcode
