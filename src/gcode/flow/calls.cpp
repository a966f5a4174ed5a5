#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "gcode/flow/flow.hpp"
#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/values/expression.hpp"
#include "gcode/values/parameters.hpp"

// Calls, returns and GOTO.
namespace twin::gcode {
namespace {

constexpr double kMostOfLabel = 1e9;
constexpr double kMostTimes = 1e6;          // of M98 L
constexpr std::size_t kMostGotos = 10000;   // places kept
constexpr std::int64_t kOldFormat = 10000;  // M98 P: repeats before the last four digits

int column_from(std::size_t at) noexcept { return static_cast<int>(at) + 1; }

Expected<std::int64_t> whole(double number, double most, int column) {
  if (!(number >= 0.0) || number > most || std::abs(number - std::round(number)) > 1e-4) {
    return fail_at(column,
                   fmt::format("{:.10g}: expected a whole number from 0 to {:g}", number, most));
  }
  return std::llround(number);
}

/// The number N of a line, or nothing.
std::optional<std::int64_t> number_of(std::string_view line) {
  std::size_t at = 0;
  skip_blanks(line, at);
  if (at_or_zero(line, at) == '/') {
    ++at;
    skip_blanks(line, at);
  }
  if (upper(at_or_zero(line, at)) != 'N') {
    return std::nullopt;
  }
  ++at;
  skip_blanks(line, at);
  std::int64_t number = 0;
  for (const std::size_t begin = at; is_digit(at_or_zero(line, at)); ++at) {
    if (at - begin > 12) {
      return std::nullopt;
    }
    number = number * 10 + (line[at] - '0');
  }
  return number;
}

}  // namespace

Expected<void> Flow::push(Frame frame, int column) {
  if (frames_.size() > kDeepest) {
    return fail_at(column, fmt::format("{} calls within calls: expected at most {}", frames_.size(),
                                       kDeepest));
  }
  frame.back = unit().source.place();
  frame.calling_line = line();
  frame.serial = ++calls_;
  frames_.push_back(std::move(frame));
  take_last_frame();
  unit().source.seek(frames_.back().body);
  return {};
}

void Flow::pop() {
  const LineSource::Place back = frames_.back().back;
  frames_.pop_back();
  take_last_frame();
  unit().source.seek(back);
}

Expected<void> Flow::call(std::string_view text, const ControlLine& control) {
  const int column = column_from(control.label_begin);
  std::string label = control.label;
  if (label.empty()) {
    std::size_t at = control.label_begin;
    TWIN_TRY(const double number, read_value(text, at, parameters_));
    TWIN_TRY(const std::int64_t of_sub, whole(number, kMostOfLabel, column));
    label = std::to_string(of_sub);
  }
  std::array<double, kMostArguments> arguments{};
  std::size_t count = 0;
  for (std::size_t at = control.rest; !is_rest_empty(text, at);) {
    skip_comments(text, at);
    if (text[at] != '[') {
      return fail_at(column_from(at), fmt::format("expected the arguments of the call in [ ], "
                                                  "found '{}'",
                                                  start_of(text.substr(at))));
    }
    if (count == kMostArguments) {
      return fail_at(column_from(at), fmt::format("expected at most {} arguments", kMostArguments));
    }
    TWIN_TRY(arguments[count++], read_value(text, at, parameters_));
  }
  TWIN_TRY(const Target target, find_sub(label, column));
  Frame frame;
  frame.kind = CallKind::kOWord;
  frame.unit = target.unit;
  frame.label = std::move(label);
  frame.body = (*units_[target.unit]->index)[target.entry].behind;
  TWIN_CHECK(push(std::move(frame), column));
  parameters_.enter(std::span(arguments).first(count));
  parameters_.set_global("_value", 0.0);
  parameters_.set_global("_value_returned", 0.0);
  return {};
}

Expected<void> Flow::end_sub(std::string_view text, const ControlLine& control) {
  const Frame& frame = frames_.back();
  const bool is_own = control.keyword == Keyword::kReturn || frame.label == control.label;
  if (frame.kind != CallKind::kOWord || !is_own) {
    return fail_at(column_from(control.label_begin),
                   fmt::format("{} {} where {} does not run: expected it between sub and endsub",
                               shown_label(control.label), name_of(control.keyword),
                               shown_label(control.label)));
  }
  if (!is_rest_empty(text, control.rest)) {
    std::size_t at = control.rest;
    TWIN_TRY(const double value, read_value(text, at, parameters_));
    parameters_.set_global("_value", value);
    parameters_.set_global("_value_returned", 1.0);
  }
  parameters_.leave();
  pop();
  return {};
}

/// A subroutine of the text that runs, of the main program, or of a file.
Expected<Flow::Target> Flow::find_sub(const std::string& label, int column) {
  for (const std::size_t of : {frames_.back().unit, std::size_t{0}}) {
    TWIN_TRY(const ControlIndex* index, index_of(*units_[of]));
    if (const auto entry = index->find_sub(label)) {
      return Target{of, *entry};
    }
  }
  TWIN_TRY(const auto of, include(label));
  if (!of) {
    return fail_at(column,
                   fmt::format("there is no {} sub in the program, and no file {}.ngc beside "
                               "it or in a folder of --subprograms",
                               shown_label(label), label));
  }
  TWIN_TRY(const ControlIndex* index, index_of(*units_[*of]));
  const auto entry = index->find_sub(label);
  if (!entry) {
    return fail_at(column,
                   fmt::format("the file {} has no {} sub", units_[*of]->name, shown_label(label)));
  }
  return Target{*of, *entry};
}

/// The unit of the file that has a label's name, or nothing where there is none.
Expected<std::optional<std::size_t>> Flow::include(const std::string& label) {
  if (const auto known = files_.find(label); known != files_.end()) {
    return known->second;
  }
  TWIN_TRY(const std::optional<ProgramText> text, units_.front()->text.subprogram(label));
  if (!text) {
    return std::nullopt;
  }
  units_.push_back(std::make_unique<Unit>(*text));
  files_.emplace(label, units_.size() - 1);
  return units_.size() - 1;
}

/// What M98 and G65 call: O1234 of the text that runs, of the main program, or a file.
Expected<Frame> Flow::numbered_frame(double number, const std::optional<double>& times,
                                     int column) {
  TWIN_TRY(const std::int64_t of_program, whole(number, kMostOfLabel, column));
  Frame frame;
  TWIN_TRY(frame.left, whole(times.value_or(1.0), kMostTimes, column));
  frame.kind = CallKind::kNumbered;
  frame.label = std::to_string(of_program);
  for (const std::size_t of : {frames_.back().unit, std::size_t{0}}) {
    TWIN_TRY(const ControlIndex* index, index_of(*units_[of]));
    frame.unit = of;
    auto entry = index->find_name(frame.label);
    if (!entry && !times && of_program >= kOldFormat) {
      entry = index->find_name(std::to_string(of_program % kOldFormat));
      if (entry) {
        frame.left = of_program / kOldFormat;
        frame.label = std::to_string(of_program % kOldFormat);
      }
    }
    if (entry) {
      frame.body = (*index)[*entry].behind;
      return frame;
    }
  }
  for (const std::string& name : {frame.label, "o" + frame.label, "O" + frame.label}) {
    TWIN_TRY(const auto of, include(name));
    if (of) {
      frame.unit = *of;
      return frame;
    }
  }
  return fail_at(column, fmt::format("there is no O{0} in the program, and no file {0}.ngc or "
                                     "O{0}.nc beside it or in a folder of --subprograms",
                                     frame.label));
}

Expected<void> Flow::call_numbered(double number, const std::optional<double>& times, int column) {
  TWIN_TRY(Frame frame, numbered_frame(number, times, column));
  return frame.left > 0 ? push(std::move(frame), column) : Expected<void>();
}

Expected<void> Flow::call_macro(double number, const std::optional<double>& times,
                                const MacroArguments& arguments, int column) {
  TWIN_TRY(Frame frame, numbered_frame(number, times.value_or(1.0), column));
  if (frame.left == 0) {
    return {};
  }
  frame.kind = CallKind::kMacro;
  frame.arguments.assign(arguments.begin(), arguments.end());
  TWIN_CHECK(push(std::move(frame), column));
  parameters_.enter_macro(arguments);
  return {};
}

Expected<bool> Flow::return_from_numbered(const std::optional<double>& to_line, int column) {
  Frame& frame = frames_.back();
  if (frame.kind == CallKind::kMain) {
    return false;
  }
  if (frame.kind == CallKind::kOWord) {
    return fail_at(column, fmt::format("M99 in {}: expected endsub or return, M99 ends O{}",
                                       shown_label(frame.label), frame.label));
  }
  const bool is_macro = frame.kind == CallKind::kMacro;
  if (is_macro) {
    parameters_.leave();
  }
  if (--frame.left > 0) {
    if (is_macro) {
      MacroArguments arguments{};
      std::copy(frame.arguments.begin(), frame.arguments.end(), arguments.begin());
      parameters_.enter_macro(arguments);
    }
    frame.has_words = false;
    frame.loops.clear();
    unit().source.seek(frame.body);
    return true;
  }
  pop();
  if (to_line) {
    TWIN_CHECK(go_to_line(*to_line, column));
  }
  return true;
}

Expected<void> Flow::go_to_line(double number, int column) {
  TWIN_TRY(const std::int64_t wanted, whole(number, kMostOfLabel, column));
  const auto key = std::tuple(frames_.back().unit, unit().source.place().offset, wanted);
  const auto known = gotos_.find(key);
  if (known != gotos_.end()) {
    unit().source.seek(known->second);
    return {};
  }
  TWIN_TRY(const LineSource::Place place, find_line(wanted, column));
  if (gotos_.size() == kMostGotos) {
    gotos_.clear();
  }
  gotos_.emplace(key, place);
  unit().source.seek(place);
  return {};
}

/// The place of a line N: from here to the end of this program, then from its begin.
Expected<LineSource::Place> Flow::find_line(std::int64_t number, int column) {
  LineSource& source = unit().source;
  const LineSource::Place here = source.place();
  TWIN_TRY(const ControlIndex* index, index_of(unit()));
  const ControlIndex::Extent extent = index->extent_around(here.offset - 1, source.size());
  for (const bool is_from_here : {true, false}) {
    source.seek(is_from_here ? here : extent.begin);
    const std::int64_t end = is_from_here ? extent.end : here.offset;
    while (source.place().offset < end) {
      const LineSource::Place place = source.place();
      TWIN_TRY(const auto line, source.next());
      if (!line) {
        break;
      }
      if (number_of(*line) == number) {
        return place;
      }
    }
  }
  source.seek(here);
  return fail_at(column, fmt::format("there is no line N{} to go to", number));
}

}  // namespace twin::gcode
