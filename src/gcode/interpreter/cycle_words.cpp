#include "gcode/interpreter/cycle_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "gcode/interpreter/modal_state.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

/// A cycle's name, what it does, and the words that it needs besides Z and R.
struct Cycle {
  GWord code;
  std::string_view name;
  CycleKind kind;
  bool needs_peck;
  bool needs_dwell;
};

constexpr Cycle kCycles[] = {
    {GWord::kChipBreak, "G73", CycleKind::kChipBreak, true, false},
    {GWord::kTapLeft, "G74", CycleKind::kTap, false, false},
    {GWord::kDrill, "G81", CycleKind::kDrill, false, false},
    {GWord::kDrillDwell, "G82", CycleKind::kDwell, false, true},
    {GWord::kPeckDrill, "G83", CycleKind::kPeck, true, false},
    {GWord::kTapRight, "G84", CycleKind::kTap, false, false},
    {GWord::kBoreFeedOut, "G85", CycleKind::kFeedOut, false, false},
    {GWord::kBoreRapidOut, "G86", CycleKind::kBore, false, true},
    {GWord::kBoreDwell, "G89", CycleKind::kDwellFeed, false, true},
};

const Cycle& cycle_of(GWord code) {
  for (const Cycle& cycle : kCycles) {
    if (cycle.code == code) {
      return cycle;
    }
  }
  return kCycles[2];
}

int place_of(const LineWords& words) {
  const int column = words.first_column("XYZRQPLK");
  return column > 0 ? column : words.column(GGroup::kMotion);
}

}  // namespace

Expected<void> CycleWords::keep(const LineWords& words, char up) {
  const auto take = [&words](char letter, std::optional<double>& kept) {
    if (words.has(letter)) {
      kept = words.value(letter);
    }
  };
  take(up, kept_.bottom);
  take('R', kept_.retract);
  take('Q', kept_.peck);
  if (words.has('P') && words.value('P') < 0.0) {
    return fail_at(words.column('P'),
                   fmt::format("P{:.10g}: expected zero or more", words.value('P')));
  }
  take('P', kept_.dwell);
  const Cycle& cycle = cycle_of(code_);
  const auto lacks = [&](std::string_view what) {
    return fail_at(place_of(words), fmt::format("{} has no {}", cycle.name, what));
  };
  if (!kept_.bottom) {
    return lacks(fmt::format("depth: expected {} on its first line", up));
  }
  if (!kept_.retract) {
    return lacks("height to drill from: expected R on its first line");
  }
  if (cycle.needs_peck && !kept_.peck) {
    return lacks("depth of a peck: expected Q on its first line");
  }
  if (cycle.needs_dwell && !kept_.dwell) {
    return lacks("time at the bottom: expected P on its first line");
  }
  return {};
}

Expected<std::int64_t> CycleWords::repeats(const LineWords& words) const {
  const char letter = words.has('L') ? 'L' : 'K';
  if (!words.has(letter)) {
    return 1;
  }
  const double count = words.value(letter);
  if (!(count >= 1.0 && count <= static_cast<double>(kMostRepeats)) || count != std::floor(count)) {
    return fail_at(words.column(letter),
                   fmt::format("{}{:.10g}: expected the repeats of a canned cycle, a whole number "
                               "from 1 to {}",
                               letter, count, kMostRepeats));
  }
  return static_cast<std::int64_t>(count);
}

Expected<void> CycleWords::check(const CycleLine& line, int column) const {
  const Cycle& cycle = cycle_of(code_);
  if (line.retract < line.bottom) {
    return fail_at(column, fmt::format("{} drills from R at {:.6g} mm up to {:.6g} mm: expected R "
                                       "above the bottom of the hole",
                                       cycle.name, line.retract, line.bottom));
  }
  if (!cycle.needs_peck) {
    return {};
  }
  if (!(line.peck > 0.0)) {
    return fail_at(column, fmt::format("Q{:.6g} of {}: expected the depth of a peck, above zero",
                                       *kept_.peck, cycle.name));
  }
  if ((line.retract - line.bottom) / line.peck > static_cast<double>(kMostPecks)) {
    return fail_at(column,
                   fmt::format("{} of {:.6g} mm in pecks of {:.6g} mm: expected at most {} "
                               "pecks",
                               cycle.name, line.retract - line.bottom, line.peck, kMostPecks));
  }
  return {};
}

Expected<CycleLine> CycleWords::read(const LineWords& words, const ModalState& state,
                                     const Vec3& place, const Vec3& hole) {
  const GWord code = state.cycle;
  const PlaneAxes axes = axes_of(state.plane);
  const char up = "XYZ"[axes.third];
  if (!initial_ || code != code_) {
    kept_ = {};
  }
  if (!initial_) {
    initial_ = place[axes.third];
  }
  code_ = code;
  TWIN_CHECK(keep(words, up));
  CycleLine line;
  line.kind = cycle_of(code).kind;
  line.plane = state.plane;
  TWIN_TRY(line.repeats, repeats(words));
  line.first = hole;
  if (state.is_incremental) {
    line.step = hole - place;
    line.step[axes.third] = 0.0;
    if (words.has_any(kPolarLetters)) {
      line.polar_step = Vec2(words.value_or_zero(kPolarRadius) * state.unit,
                             words.value_or_zero(kPolarAngle) * std::numbers::pi / 180.0);
    }
  }
  line.initial = *initial_;
  const double base = state.is_incremental ? line.initial : 0.0;
  line.retract = base + *kept_.retract * state.unit;
  line.bottom = (state.is_incremental ? line.retract : 0.0) + *kept_.bottom * state.unit;
  line.peck = kept_.peck.value_or(0.0) * state.unit;
  line.dwell = kept_.dwell.value_or(0.0);
  line.returns_to_retract = state.returns_to_retract;
  TWIN_CHECK(check(line, place_of(words)));
  return line;
}

}  // namespace twin::gcode
