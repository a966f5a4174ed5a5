#include "gcode/interpreter/set_up.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "gcode/interpreter/axis_words.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "gcode/interpreter/plane.hpp"
#include "gcode/notes.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

constexpr std::uint32_t kGroups =
    LineWords::groups_of(GGroup::kSetting, GGroup::kToolLength, GGroup::kWorkOffset,
                         GGroup::kScaling, GGroup::kMirror, GGroup::kRotation, GGroup::kPolar);

constexpr int kHome = 5161;        // X of G28; Y and Z follow
constexpr int kSecondHome = 5181;  // X of G30
constexpr int kTool = 5400;
constexpr int kToolOffset = 5401;
constexpr int kToolDiameter = 5410;

}  // namespace

SetUp::SetUp(const ReaderOptions& options) : dialect_(options.dialect) {
  coordinates_.place_workpiece(options.workpiece);
  if (options.tools) {
    tools_ = *options.tools;
  }
}

bool SetUp::concerns(const LineWords& words) noexcept { return (words.g_groups() & kGroups) != 0; }

Expected<void> SetUp::change_tool(const LineWords& words) {
  constexpr double kMost = 1e9;
  if (words.has('T')) {
    if (!is_whole_in(words.value('T'), 0.0, kMost)) {
      return fail_at(words.column('T'), "T: expected the number of a tool");
    }
    selected_tool_ = static_cast<int>(words.value('T'));
  }
  if (!words.has(MGroup::kToolChange)) {
    return {};
  }
  tool_ = selected_tool_;
  if (words.m(MGroup::kToolChange) == MWord::kToolNumber) {
    if (!words.has('Q') || !is_whole_in(words.value('Q'), 0.0, kMost)) {
      return fail_at(words.column(MGroup::kToolChange),
                     "M61 sets the number of the tool: expected Q and that number");
    }
    tool_ = static_cast<int>(words.value('Q'));
  }
  return {};
}

Expected<void> SetUp::apply(const LineWords& words, const ModalState& state, Vec3& place,
                            Notes& notes, std::int64_t line) {
  const Vec3 machine = coordinates_.machine_of(place);
  const std::uint64_t version = coordinates_.version();
  const bool turns = words.has(GGroup::kMirror) || words.has(GGroup::kRotation);
  if (words.has(GGroup::kToolLength)) {
    TWIN_CHECK(set_tool_offset(words, state, notes, line));
  }
  if (words.has(GGroup::kWorkOffset)) {
    TWIN_CHECK(select_work_offset(words));
  }
  TWIN_CHECK(overlay(words, state, coordinates_.program_of(machine)));
  if (words.has(GGroup::kSetting)) {
    TWIN_CHECK(set(words, state, coordinates_.program_of(machine)));
  }
  if (coordinates_.version() == version) {
    return {};
  }
  const Vec3 before = std::exchange(place, coordinates_.program_of(machine));
  for (Eigen::Index axis = 0; turns && axis < 3; ++axis) {
    if (std::abs(before[axis] - place[axis]) > 1e-6) {
      axes_to_name_ |= 1U << static_cast<unsigned>(axis);
    }
  }
  if (words.has(GGroup::kSetting, GWord::kShift)) {
    take_axes(words, state.unit, place);
  }
  return {};
}

void SetUp::restore(std::size_t work_offset, const Vec3& tool_offset, Vec3& place) {
  const Vec3 machine = coordinates_.machine_of(place);
  const std::uint64_t version = coordinates_.version();
  if (coordinates_.selected() != work_offset) {
    coordinates_.select(work_offset);
  }
  if (coordinates_.tool() != tool_offset) {
    coordinates_.set_tool(tool_offset);
  }
  if (coordinates_.version() != version) {
    place = coordinates_.program_of(machine);
  }
}

const Tool* SetUp::tool_or_note(int number, std::string_view what, Notes& notes,
                                std::int64_t line) const {
  const Tool* tool = tools_.find(number);
  if (tool == nullptr) {
    notes.add(NoteKind::kTool,
              number == 0 ? fmt::format("no tool is in the spindle: its {} is taken as 0", what)
                          : fmt::format("tool {} is not in the tool table: its {} is taken as 0",
                                        number, what),
              line);
  }
  return tool;
}

Expected<void> SetUp::set_tool_offset(const LineWords& words, const ModalState& state, Notes& notes,
                                      std::int64_t line) {
  const GWord word = words.g(GGroup::kToolLength);
  if (word == GWord::kNoToolLength) {
    coordinates_.set_tool(Vec3::Zero());
    return {};
  }
  Vec3 offset = coordinates_.tool();
  const bool is_dynamic = word != GWord::kToolLength;
  if (is_dynamic && words.has_any(kAxes)) {
    if (words.has('H')) {
      return fail_at(words.column('H'), "H beside X, Y or Z of G43.2: expected one of them");
    }
    Vec3 numbers = word == GWord::kToolOffset ? offset : Vec3(Vec3::Zero());
    take_axes(words, state.unit, numbers);
    coordinates_.set_tool(word == GWord::kToolOffset ? numbers : Vec3(offset + numbers));
    return {};
  }
  if (is_dynamic && (word == GWord::kToolOffset || !words.has('H'))) {
    return fail_at(words.column(GGroup::kToolLength),
                   word == GWord::kToolOffset ? "G43.1 has no offset: expected X, Y or Z"
                                              : "G43.2 has no offset: expected H, or X, Y or Z");
  }
  const double h = words.value_or_zero('H');
  if (h > 1e9) {
    return fail_at(words.column('H'), "H: expected the number of a tool");
  }
  if (dialect_ == Dialect::kFanuc && words.has('H') && h == 0.0) {
    coordinates_.set_tool(Vec3::Zero());
    return {};
  }
  const int number = h == 0.0 ? tool_ : static_cast<int>(h);
  const Tool* tool = tool_or_note(number, "length", notes, line);
  const Vec3 length = tool == nullptr ? Vec3(Vec3::Zero()) : tool->offset;
  coordinates_.set_tool(is_dynamic ? Vec3(offset + length) : length);
  return {};
}

Expected<void> SetUp::select_work_offset(const LineWords& words) {
  if (words.g(GGroup::kWorkOffset) == GWord::kExtendedWorkOffset) {
    const double number = words.value_or_zero('P');
    if (!is_whole_in(number, 1.0, static_cast<double>(Coordinates::kExtended))) {
      return fail_at(words.has('P') ? words.column('P') : words.column(GGroup::kWorkOffset),
                     fmt::format("G54.1 selects a further work offset: expected P from 1 to {}",
                                 Coordinates::kExtended));
    }
    coordinates_.select(Coordinates::kSystems + static_cast<std::size_t>(number) - 1);
    return {};
  }
  const double number = words.g_number(GGroup::kWorkOffset);
  const double system = number < 59.05 ? number - 54.0 : 5.0 + (number - 59.0) * 10.0;
  coordinates_.select(static_cast<std::size_t>(std::lround(system)));
  return {};
}

/// G68, G69, G51.1, G50.1 and G50.
Expected<void> SetUp::overlay(const LineWords& words, const ModalState& state, const Vec3& place) {
  if (words.has(GGroup::kScaling) && (words.has_any("XYZPS"))) {
    return fail_at(words.column(GGroup::kScaling),
                   "G50 beside other words is a setting of lathes: expected it alone, as the end "
                   "of scaling");
  }
  if (words.has(GGroup::kRotation, GWord::kNoRotation)) {
    coordinates_.set_rotation({});
  } else if (words.has(GGroup::kRotation)) {
    if (state.is_incremental || !words.has('R')) {
      return fail_at(words.column(GGroup::kRotation),
                     "G68 turns the coordinates: expected G90, X and Y of the centre, and the "
                     "angle R in degrees");
    }
    Overlay rotation{Eigen::Matrix3d::Identity(), place, true};
    take_axes(words, state.unit, rotation.centre);
    rotation.turn = rotation_about(static_cast<int>(axes_of(state.plane).third), words.value('R'));
    coordinates_.set_rotation(rotation);
  }
  if (!words.has(GGroup::kMirror)) {
    return {};
  }
  const bool begins = words.g(GGroup::kMirror) == GWord::kMirror;
  if (begins && (!words.has_any(kAxes) || state.is_incremental)) {
    return fail_at(words.column(GGroup::kMirror),
                   "G51.1 makes a mirror image: expected G90, and X, Y or Z where the mirror is");
  }
  Overlay mirror = coordinates_.scaling();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char letter = kAxes[static_cast<std::size_t>(axis)];
    if (words.has(letter) || (!begins && !words.has_any(kAxes))) {
      mirror.turn(axis, axis) = begins ? -1.0 : 1.0;
      mirror.centre[axis] = begins ? words.value(letter) * state.unit : 0.0;
    }
  }
  mirror.is_on = mirror.turn != Eigen::Matrix3d::Identity();
  coordinates_.set_scaling(mirror);
  return {};
}

/// The words of group kSetting; the moves of G28 and G30 come later.
Expected<void> SetUp::set(const LineWords& words, const ModalState& state, const Vec3& place) {
  const Vec3 machine = coordinates_.machine_of(place);
  switch (words.g(GGroup::kSetting)) {
    case GWord::kSetOffsets:
      return set_offsets(words, state, place);
    case GWord::kSetHome:
    case GWord::kSetSecondHome:
      if (words.has_any(kAxes)) {
        return fail_at(words.first_column(kAxes),
                       "G28.1 and G30.1 keep the place where the machine is: expected no X, Y, Z");
      }
      homes_[words.g(GGroup::kSetting) == GWord::kSetHome ? 0 : 1] = machine;
      return {};
    case GWord::kClearShift:
      coordinates_.set_shift(Vec3::Zero(), false);
      return {};
    case GWord::kShiftOff:
      coordinates_.set_shift(coordinates_.shift(), false);
      return {};
    case GWord::kShiftOn:
      coordinates_.set_shift(coordinates_.shift(), true);
      return {};
    case GWord::kShift:
    case GWord::kLocalOffset:
      return set_shift(words, state, place);
    default:
      return {};
  }
}

/// G92 gives the place where the tool is new coordinates, G52 the origin a new place.
Expected<void> SetUp::set_shift(const LineWords& words, const ModalState& state,
                                const Vec3& place) {
  const bool is_local = words.g(GGroup::kSetting) == GWord::kLocalOffset;
  if (!words.has_any(kAxes) && words.has_left_out()) {
    return {};
  }
  if (!words.has_any(kAxes)) {
    return fail_at(
        words.column(GGroup::kSetting),
        fmt::format("{} has no coordinates: expected X, Y or Z", is_local ? "G52" : "G92"));
  }
  if (coordinates_.rotation().is_on || coordinates_.scaling().is_on) {
    return fail_at(words.column(GGroup::kSetting),
                   fmt::format("{} with G68 or G51.1 in force: expected G69 and G50.1 before it",
                               is_local ? "G52" : "G92"));
  }
  const Vec3 shift = coordinates_.is_shift_on() ? coordinates_.shift() : Vec3(Vec3::Zero());
  Vec3 changed = is_local ? shift : place;
  take_axes(words, state.unit, changed);
  coordinates_.set_shift(is_local ? changed : Vec3(shift + place - changed), true);
  return {};
}

Expected<double> SetUp::cutter_radius(const LineWords& words, const ModalState& state, Notes& notes,
                                      std::int64_t line) const {
  const GWord word = words.g(GGroup::kCutterCompensation);
  const bool is_left = word == GWord::kCutterLeft || word == GWord::kCutterLeftOf;
  const bool is_given = word == GWord::kCutterLeftOf || word == GWord::kCutterRightOf;
  double diameter = 0.0;
  if (is_given) {
    if (!words.has('D')) {
      return fail_at(words.column(GGroup::kCutterCompensation),
                     "G41.1 and G42.1 need the diameter of the cutter: expected D");
    }
    if (words.has('L') && words.value('L') != 0.0) {
      return fail_at(words.column('L'), "L is the orientation of a lathe tool: expected none");
    }
    diameter = words.value('D') * state.unit;
  } else {
    if (words.has('L')) {
      return fail_at(words.column('L'), "L beside G41 or G42: expected D, the number of a tool");
    }
    const double d = words.value_or_zero('D');
    if (!is_whole_in(d, 0.0, 1e9)) {
      return fail_at(words.column('D'),
                     fmt::format("D{:.10g} of G41 or G42 is the number of a tool: expected a whole "
                                 "number; a diameter goes with G41.1 or G42.1",
                                 d));
    }
    const Tool* tool =
        tool_or_note(d == 0.0 ? tool_ : static_cast<int>(d), "diameter", notes, line);
    diameter = tool == nullptr ? 0.0 : tool->diameter;
  }
  return is_left ? diameter / 2.0 : -diameter / 2.0;
}

std::optional<double> SetUp::parameter(int number) const {
  if (number >= kHome && number < kHome + 3) {
    return homes_[0][number - kHome];
  }
  if (number >= kSecondHome && number < kSecondHome + 3) {
    return homes_[1][number - kSecondHome];
  }
  if (number == kTool) {
    return tool_;
  }
  if (number >= kToolOffset && number < kToolOffset + 3) {
    return coordinates_.tool()[number - kToolOffset];
  }
  if (number == kToolDiameter) {
    const Tool* tool = tools_.find(tool_);
    return tool == nullptr ? 0.0 : tool->diameter;
  }
  return coordinates_.parameter(number);
}

bool SetUp::set_parameter(int number, double value) {
  if (number >= kHome && number < kHome + 3) {
    homes_[0][number - kHome] = value;
    return true;
  }
  if (number >= kSecondHome && number < kSecondHome + 3) {
    homes_[1][number - kSecondHome] = value;
    return true;
  }
  return coordinates_.set_parameter(number, value);
}

}  // namespace twin::gcode
