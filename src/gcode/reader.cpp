#include "gcode/reader.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "gcode/lexer.hpp"

namespace twin::gcode {
namespace {

constexpr std::int64_t kLargestLine = std::numeric_limits<int>::max();  // an Error can hold

}  // namespace

Reader::Reader(const ProgramText& program, const ReaderOptions& options)
    : source_(program),
      name_(program.file().string()),
      skips_deleted_blocks_(options.block_delete),
      interpreter_(options.start, options.feedrate) {}

Expected<Reader> Reader::open(const std::string& path, const ReaderOptions& options) {
  TWIN_TRY(const ProgramText program, ProgramText::read(path));
  return Reader(program, options);
}

Reader Reader::from_text(std::string text, std::string name, const ReaderOptions& options) {
  return Reader(ProgramText::from_text(std::move(text), std::move(name)), options);
}

Expected<std::optional<Block>> Reader::next() {
  if (error_) {
    return tl::unexpected<Error>(*error_);
  }
  while (next_block_ == blocks_.count) {
    if (is_at_end_) {
      if (auto finished = finish(); !finished) {
        return stop_with(std::move(finished.error()));
      }
      return std::nullopt;
    }
    if (auto read = read_line(); !read) {
      return stop_with(std::move(read.error()));
    }
  }
  Block& block = blocks_.block[next_block_++];
  has_moved_ = has_moved_ || block.motion != Motion::kDwell;
  return std::optional<Block>(std::move(block));
}

/// Reads one line into blocks_, which is empty if the line does not move.
Expected<void> Reader::read_line() {
  next_block_ = blocks_.count = 0;
  TWIN_TRY(const auto line, source_.next());
  if (!line) {
    is_at_end_ = true;
    return {};
  }
  std::string_view text = *line;
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) {
    return {};
  }
  if (text[begin] == '%') {
    return read_percent_line(text, static_cast<int>(begin) + 1);
  }
  ++text_lines_;
  std::size_t stepped_over = 0;
  if (text[begin] == '/') {
    if (skips_deleted_blocks_) {
      return {};
    }
    stepped_over = begin + 1;
    text.remove_prefix(stepped_over);
  }
  Expected<void> done = words_.read(text);
  if (done && !words_.is_empty()) {
    done = interpreter_.execute(words_, source_.line(), blocks_);
    is_at_end_ = blocks_.is_end;
  }
  if (!done && done.error().column > 0) {
    done.error().column += static_cast<int>(stepped_over);
  }
  return done;
}

/// The first % line opens the program, the second ends it.
Expected<void> Reader::read_percent_line(std::string_view text, int column) {
  if (has_percent_) {
    is_at_end_ = true;
    return {};
  }
  if (text_lines_ > 0) {
    return fail_at(column, "% after the program has begun: expected it before every other line");
  }
  has_percent_ = true;
  auto read = words_.read(text.substr(static_cast<std::size_t>(column)));
  if (!read && read.error().column > 0) {
    read.error().column += column;
  }
  if (read && !words_.is_empty()) {
    return fail_at(column + 1, "words after %: expected them on the next line");
  }
  return read;
}

Expected<void> Reader::finish() {
  TWIN_CHECK(interpreter_.finish());
  if (has_moved_) {
    return {};
  }
  if (source_.line() == 0) {
    return fail_at(0, "the file is empty: expected an NC program");
  }
  return fail_at(0, "the program holds no motion: expected at least one move by G00 to G03");
}

/// Remembers an error, with file and line if they belong to it, for this call and all that follow.
tl::unexpected<Error> Reader::stop_with(Error error) {
  if (error.file.empty()) {
    error.file = name_;
  }
  if (error.column > 0 && error.line == 0) {
    error.line = static_cast<int>(std::min(source_.line(), kLargestLine));
  }
  blocks_.count = next_block_ = 0;
  error_ = error;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace twin::gcode
