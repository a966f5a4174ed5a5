#include <fmt/format.h>

#include <cmath>
#include <string>

#include "gcode/flow/flow.hpp"
#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/values/expression.hpp"
#include "gcode/values/parameters.hpp"

// Branches and loops.
namespace twin::gcode {
namespace {

constexpr double kMostRuns = 1e9;  // of a repeat

int column_at(std::size_t at) noexcept { return static_cast<int>(at) + 1; }

/// Why a line of flow control without a partner cannot be executed.
tl::unexpected<Error> lacks(const ControlLine& control, std::string_view missing) {
  return fail_at(column_at(control.label_begin),
                 fmt::format("{} {}: expected {} {}", shown_label(control.label),
                             name_of(control.keyword), shown_label(control.label), missing));
}

Expected<void> expect_end(std::string_view text, std::size_t at) {
  if (is_rest_empty(text, at)) {
    return {};
  }
  skip_blanks(text, at);
  return fail_at(column_at(at), fmt::format("expected the end of the line, found '{}'",
                                            start_of(text.substr(at))));
}

}  // namespace

Expected<ExecutedLine> Flow::control(std::string_view text, std::size_t at, std::int64_t offset) {
  TWIN_TRY(const ControlLine control, read_control_line(text, at));
  switch (control.keyword) {
    case Keyword::kMacroIf:
      return macro_if(text, control);
    case Keyword::kMacroWhile:
    case Keyword::kMacroDo:
    case Keyword::kMacroEnd:
      TWIN_CHECK(macro_loop(text, control, offset));
      return ExecutedLine{};
    case Keyword::kGoto: {
      std::size_t place = control.rest;
      TWIN_TRY(const double number, read_value(text, place, parameters_));
      TWIN_CHECK(expect_end(text, place));
      TWIN_CHECK(go_to_line(number, column_at(control.rest)));
      return ExecutedLine{};
    }
    default:
      TWIN_CHECK(o_word(text, control, offset));
      return ExecutedLine{};
  }
}

Expected<void> Flow::o_word(std::string_view text, const ControlLine& control,
                            std::int64_t offset) {
  if (control.keyword == Keyword::kCall) {
    return call(text, control);
  }
  if (control.label.empty()) {
    return fail_at(column_at(control.label_begin),
                   "a computed O-word: expected call behind it, others have a number or a name");
  }
  switch (control.keyword) {
    case Keyword::kName:
      return begin_name(control);
    case Keyword::kReturn:
    case Keyword::kEndSub:
      return end_sub(text, control);
    default:
      break;
  }
  TWIN_TRY(const ControlIndex* index, index_of(unit()));
  const std::size_t entry = index->at_offset(offset);
  switch (control.keyword) {
    case Keyword::kSub:
      if (!(*index)[entry].partner) {
        return lacks(control, "endsub");
      }
      unit().source.seek((*index)[*(*index)[entry].partner].behind);
      return {};
    case Keyword::kIf:
    case Keyword::kElseIf:
    case Keyword::kElse:
    case Keyword::kEndIf:
      return branch(text, control, *index, entry);
    case Keyword::kBreak:
    case Keyword::kContinue:
      return leave_loop(control, *index, entry);
    default:
      return loop(text, control, *index, entry);
  }
}

Expected<void> Flow::begin_name(const ControlLine& control) {
  const Frame& frame = frames_.back();
  if (!frame.has_words) {
    return {};
  }
  return fail_at(column_at(control.label_begin),
                 fmt::format("another program begins, O{}: expected {} before it", control.label,
                             frame.kind == CallKind::kMain ? "M02 or M30" : "M99"));
}

Expected<bool> Flow::condition(std::string_view text, std::size_t at) {
  TWIN_TRY(const double value, read_value(text, at, parameters_));
  TWIN_CHECK(expect_end(text, at));
  return value != 0.0;
}

Expected<void> Flow::branch(std::string_view text, const ControlLine& control,
                            const ControlIndex& index, std::size_t entry) {
  if (!index[entry].partner) {
    return lacks(control, control.keyword == Keyword::kIf ? "endif" : "if before it");
  }
  if (control.keyword == Keyword::kEndIf) {
    return {};
  }
  if (control.keyword == Keyword::kIf) {
    TWIN_TRY(const bool is_true, condition(text, control.rest));
    return is_true ? Expected<void>() : take_next_branch(control, index, entry);
  }
  // The branch before ends here.
  while (index[entry].keyword != Keyword::kEndIf) {
    if (!index[entry].partner) {
      return lacks(control, "endif");
    }
    entry = *index[entry].partner;
  }
  unit().source.seek(index[entry].behind);
  return {};
}

/// Goes along the branches behind one that is not taken.
Expected<void> Flow::take_next_branch(const ControlLine& control, const ControlIndex& index,
                                      std::size_t entry) {
  LineSource& source = unit().source;
  while (index[entry].partner) {
    entry = *index[entry].partner;
    source.seek(index[entry].begin);
    TWIN_TRY(const auto line, source.next());
    if (index[entry].keyword != Keyword::kElseIf) {
      return {};
    }
    TWIN_TRY(const ControlLine branch, read_control_line(*line, begin_of_words(*line, 0)));
    TWIN_TRY(const bool is_true, condition(*line, branch.rest));
    if (is_true) {
      return {};
    }
  }
  return lacks(control, "endif");
}

Expected<void> Flow::loop(std::string_view text, const ControlLine& control,
                          const ControlIndex& index, std::size_t entry) {
  LineSource& source = unit().source;
  const std::optional<std::size_t> partner = index[entry].partner;
  switch (control.keyword) {
    case Keyword::kWhile: {
      if (!partner) {
        return lacks(control, "endwhile");
      }
      const bool is_behind = index[*partner].keyword == Keyword::kDo;
      TWIN_TRY(const bool is_true, condition(text, control.rest));
      if (is_true == is_behind) {
        source.seek(index[*partner].behind);
      }
      return {};
    }
    case Keyword::kEndWhile:
      if (!partner) {
        return lacks(control, "while before it");
      }
      source.seek(index[*partner].begin);
      return {};
    case Keyword::kRepeat: {
      if (!partner) {
        return lacks(control, "endrepeat");
      }
      std::size_t at = control.rest;
      TWIN_TRY(const double runs, read_value(text, at, parameters_));
      TWIN_CHECK(expect_end(text, at));
      if (!(runs <= kMostRuns)) {
        return fail_at(column_at(control.rest),
                       fmt::format("repeat [{:.10g}]: expected at most {:g}", runs, kMostRuns));
      }
      frames_.back().loop(entry) = static_cast<std::int64_t>(std::round(runs));
      if (runs < 0.5) {
        source.seek(index[*partner].behind);
      }
      return {};
    }
    case Keyword::kEndRepeat:
      if (!partner) {
        return lacks(control, "repeat before it");
      }
      if (--frames_.back().loop(*partner) > 0) {
        source.seek(index[*partner].behind);
      }
      return {};
    default:
      return partner ? Expected<void>() : lacks(control, "while behind it");
  }
}

Expected<void> Flow::leave_loop(const ControlLine& control, const ControlIndex& index,
                                std::size_t entry) {
  const std::optional<std::size_t> begin = index[entry].partner;
  if (!begin || !index[*begin].partner) {
    return lacks(control, "while, do or repeat around it");
  }
  const ControlEntry& end = index[*index[*begin].partner];
  if (control.keyword == Keyword::kBreak) {
    unit().source.seek(end.behind);
  } else {
    unit().source.seek(index[*begin].keyword == Keyword::kWhile ? index[*begin].begin : end.begin);
  }
  return {};
}

/// IF [condition] GOTO n, IF [condition] THEN statement.
Expected<ExecutedLine> Flow::macro_if(std::string_view text, const ControlLine& control) {
  std::size_t at = control.rest;
  TWIN_TRY(const double truth, read_value(text, at, parameters_));
  skip_blanks(text, at);
  const std::size_t word = at;
  if (upper(at_or_zero(text, at)) == 'T') {
    at += std::string_view("THEN").size();
    const bool is_taken = truth != 0.0 && at < text.size();
    return is_taken ? ExecutedLine{text.substr(at), at} : ExecutedLine{};
  }
  if (upper(at_or_zero(text, at)) != 'G' || upper(at_or_zero(text, at + 1)) != 'O') {
    return fail_at(column_at(word),
                   fmt::format("expected GOTO or THEN, found '{}'", start_of(text.substr(word))));
  }
  TWIN_TRY(const ControlLine jump, read_control_line(text, at));
  at = jump.rest;
  TWIN_TRY(const double number, read_value(text, at, parameters_));
  TWIN_CHECK(expect_end(text, at));
  if (truth != 0.0) {
    TWIN_CHECK(go_to_line(number, column_at(jump.rest)));
  }
  return ExecutedLine{};
}

Expected<void> Flow::macro_loop(std::string_view text, const ControlLine& control,
                                std::int64_t offset) {
  TWIN_TRY(const ControlIndex* index, index_of(unit()));
  const std::size_t entry = index->at_offset(offset);
  const std::optional<std::size_t> partner = (*index)[entry].partner;
  const int column = column_at(control.keyword_begin);
  if (!partner) {
    return fail_at(column, control.keyword == Keyword::kMacroEnd
                               ? "END: expected DO of the same number before it"
                               : "DO: expected END of the same number behind it");
  }
  const ControlEntry& other = (*index)[*partner];
  if (control.keyword == Keyword::kMacroEnd) {
    unit().source.seek(other.keyword == Keyword::kMacroWhile ? other.begin : other.behind);
  } else if (control.keyword == Keyword::kMacroWhile) {
    std::size_t at = control.rest;
    TWIN_TRY(const double truth, read_value(text, at, parameters_));
    if (truth == 0.0) {
      unit().source.seek(other.behind);
    }
  }
  return {};
}

}  // namespace twin::gcode
