#include "gcode/flow/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/stop_wish.hpp"
#include "gcode/notes.hpp"
#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/values/parameters.hpp"

namespace twin::gcode {
namespace {

constexpr std::int64_t kLinesToWish = 1024;  // every so many lines that come again
constexpr std::string_view kBlanksOfLine = " \t";

}  // namespace

Flow::Flow(const ProgramText& program, const ReaderOptions& options, Parameters& parameters,
           Notes& notes)
    : options_(options), parameters_(parameters), notes_(notes) {
  units_.push_back(std::make_unique<Unit>(program));
  frames_.emplace_back();
  take_last_frame();
}

std::int64_t Flow::line_of_main_program() const noexcept {
  for (const Frame& frame : frames_) {
    if (frame.unit != 0) {
      return frame.calling_line;
    }
  }
  return line();
}

Expected<bool> Flow::next(ExecutedLine& executed) {
  while (true) {
    Unit& text = unit();
    const std::int64_t offset = text.source.bytes_read();
    is_broken_ = true;  // until a line is read
    TWIN_TRY(const auto line, text.source.next());
    if (!line) {
      if (frames_.size() == 1) {
        return false;
      }
      return tl::unexpected(end_text());
    }
    if (text.source.line() > text.furthest) {
      text.furthest = text.source.line();
    } else {
      TWIN_CHECK(count_repeated_line());
    }
    is_broken_ = false;
    const std::size_t stepped_over = text.source.stepped_over();
    if (stepped_over > 0) {
      notes_.add(NoteKind::kText, "control characters before a line's words are left out",
                 main_line());
    }
    const bool begins_at_once = !line->empty() && !is_blank(line->front());
    const std::size_t first = begins_at_once ? 0 : line->find_first_not_of(kBlanksOfLine);
    if (first == std::string_view::npos) {
      continue;
    }
    executed = {*line, 0};
    std::size_t begin = first;
    const char c = (*line)[first];
    if (c == '%') {
      TWIN_TRY(const bool is_end, ends_at_percent(*line, first));
      if (is_end) {
        return false;
      }
      continue;
    }
    if (c == '/') {
      if (options_.block_delete) {
        continue;
      }
      begin = first + 1;
      executed = {line->substr(begin), begin};
    }
    if (upper(c) == 'N' || c == '/' || c == '(') {
      begin = begin_of_words(*line, begin);
    }
    if (begin < line->size() && may_be_control(*line, begin)) {
      TWIN_TRY(executed, control(*line, begin, offset));
      if (executed.text.empty()) {
        continue;
      }
    }
    executed.stepped_over += stepped_over;
    frame_->has_words = frame_->has_words || (c != '(' && c != ';');
    return true;
  }
}

/// Counts a line that comes again, and stops a program that reads the same lines for ever.
Expected<void> Flow::count_repeated_line() {
  ++repeated_;
  if (repeated_ > options_.most_lines) {
    return fail_at(1, fmt::format("the program does not end: {} lines were executed again by loops "
                                  "and calls; expected an end, or a larger program.most_lines",
                                  options_.most_lines));
  }
  return repeated_ % kLinesToWish == 0 ? check_wish(options_.stop, "interrupted: nothing has moved")
                                       : Expected<void>();
}

/// The first % opens a text, the second ends it. So does one behind which there is nothing.
Expected<bool> Flow::ends_at_percent(std::string_view text, std::size_t at) {
  const int column = static_cast<int>(at) + 1;
  if (!is_rest_empty(text, at + 1)) {
    return fail_at(column + 1, "words after %: expected them on the next line");
  }
  Unit& here = unit();
  if (!here.has_percent && !frames_.back().has_words) {
    here.has_percent = true;
    return false;
  }
  const bool is_last = is_only_blank_behind();
  if (!here.has_percent && !is_last) {
    return fail_at(column,
                   "% after the program has begun: expected it before every other line, or "
                   "behind all of them");
  }
  if (!is_last) {
    notes_.add(NoteKind::kText, "text behind the closing % is not read", main_line());
  }
  if (frames_.size() > 1) {
    return tl::unexpected(end_text());
  }
  return true;
}

bool Flow::is_only_blank_behind() {
  LineSource& source = unit().source;
  const LineSource::Place here = source.place();
  bool is_blank_so_far = true;
  while (is_blank_so_far) {
    const auto line = source.next();
    if (!line || !*line) {
      is_blank_so_far = line.has_value();
      break;
    }
    is_blank_so_far = std::all_of((*line)->begin(), (*line)->end(), [](char c) {
      return is_blank(c) || (is_control(c) && c != '\x7F');
    });
  }
  source.seek(here);
  return is_blank_so_far;
}

/// Why a text may not end while a subroutine runs.
Error Flow::end_text() const {
  const Frame& frame = frames_.back();
  const std::string message =
      frame.kind == CallKind::kOWord
          ? fmt::format("the text ends in {}: expected its endsub or return",
                        shown_label(frame.label))
          : fmt::format("the text ends in O{}: expected M99", frame.label);
  return fail_at(1, message).value();
}

Expected<const ControlIndex*> Flow::index_of(Unit& of) {
  if (!of.index) {
    TWIN_TRY(of.index, ControlIndex::of(of.text, options_.block_delete));
  }
  return &*of.index;
}

}  // namespace twin::gcode
