#include <fmt/format.h>

#include "gcode/interpreter/axis_words.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "gcode/interpreter/set_up.hpp"
#include "gcode/text/fault.hpp"

// G10: work offsets and the tool table.

namespace twin::gcode {

Expected<void> SetUp::set_offsets(const LineWords& words, const ModalState& state,
                                  const Vec3& place) {
  const double kind = words.has('L') ? words.value('L') : -1.0;
  if (dialect_ == Dialect::kFanuc && kind != 2.0) {
    return fail_at(
        words.column(GGroup::kSetting),
        "G10 of FANUC's dialect (setting of data) is supported as G10 L2 P1 to P6 alone; "
        "--dialect linuxcnc reads it as LinuxCNC does");
  }
  if (kind == 2.0 || kind == 20.0) {
    return set_work_offset(words, state, place, kind == 20.0);
  }
  if (kind == 1.0 || kind == 10.0 || kind == 11.0) {
    return set_tool(words, state, place);
  }
  if (kind == 0.0) {
    return {};
  }
  return fail_at(words.has('L') ? words.column('L') : words.column(GGroup::kSetting),
                 words.has('L')
                     ? fmt::format("G10 L{:.10g} (setting of data) is not supported: expected L1, "
                                   "L2, L10, L11 or L20",
                                   kind)
                     : "G10 does not say what it sets: expected L1, L2, L10, L11 or L20");
}

Expected<void> SetUp::set_work_offset(const LineWords& words, const ModalState& state,
                                      const Vec3& place, bool from_place) {
  if (!words.has('P') || !is_whole_in(words.value('P'), 0.0, Coordinates::kSystems)) {
    return fail_at(words.has('P') ? words.column('P') : words.column(GGroup::kSetting),
                   "G10 L2 and L20 set a work offset: expected P from 0, the one in force, to 9");
  }
  const auto p = static_cast<std::size_t>(words.value('P'));
  if (dialect_ == Dialect::kFanuc && (p == 0 || state.is_incremental)) {
    return fail_at(words.column('P'),
                   "G10 L2 P0 (offset of all systems) or with G91 is not supported: expected P1 to "
                   "P6 and G90");
  }
  const std::size_t system = p == 0 ? coordinates_.selected() : p - 1;
  WorkOffset offset = coordinates_.stored(system);
  if (!from_place) {
    take_axes(words, state.unit, offset.origin);
    offset.rotation_deg = words.has('R') ? words.value('R') : offset.rotation_deg;
    coordinates_.store(system, offset);
    return {};
  }
  if (words.has('R')) {
    return fail_at(words.column('R'), "R beside G10 L20: expected it beside G10 L2");
  }
  if (coordinates_.rotation().is_on || coordinates_.scaling().is_on) {
    return fail_at(words.column(GGroup::kSetting),
                   "G10 L20 with G68 or G51.1 in force: expected G69 and G50.1 before it");
  }
  offset.origin = coordinates_.origin_for(system, coordinates_.machine_of(place),
                                          [&](Vec3& to) { take_axes(words, state.unit, to); });
  coordinates_.store(system, offset);
  return {};
}

/// G10 L1, L10 and L11: an entry of the tool table.
Expected<void> SetUp::set_tool(const LineWords& words, const ModalState& state, const Vec3& place) {
  if (!words.has('P') || !is_whole_in(words.value('P'), 1.0, 1e9)) {
    return fail_at(words.has('P') ? words.column('P') : words.column(GGroup::kSetting),
                   "G10 sets an entry of the tool table: expected P, the number of a tool");
  }
  const double kind = words.value('L');
  if (kind != 1.0 && !coordinates_.is_shift_only()) {
    return fail_at(words.column('L'),
                   "G10 L10 and L11 in turned coordinates: expected none of G68, G51.1 and G10 R");
  }
  if (kind != 1.0 && !words.has_any(kAxes)) {
    return fail_at(words.column('L'),
                   "G10 L10 and L11 without X, Y or Z: controls do not agree whether R is a length "
                   "or a radius; expected G10 L1");
  }
  const int number = static_cast<int>(words.value('P'));
  const Tool* known = tools_.find(number);
  Tool tool = known == nullptr ? Tool{} : *known;
  if (kind == 1.0) {
    take_axes(words, state.unit, tool.offset);
  } else {
    // With the tool's offset so set, the place has the coordinates that the line names.
    const Vec3 without = kind == 10.0 ? Vec3(coordinates_.tool() + place)
                                      : coordinates_.fixture_place(coordinates_.machine_of(place));
    Vec3 wanted = without;
    take_axes(words, state.unit, wanted);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (words.has(kAxes[static_cast<std::size_t>(axis)])) {
        tool.offset[axis] = without[axis] - wanted[axis];
      }
    }
  }
  if (words.has('R')) {
    tool.diameter = 2.0 * words.value('R') * state.unit;
  }
  tools_.set(number, tool);
  return {};
}

}  // namespace twin::gcode
