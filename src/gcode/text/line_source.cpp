#include "gcode/text/line_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "gcode/text/fault.hpp"

namespace twin::gcode {
namespace {

constexpr std::size_t kBufferSize = 65536;                     // [bytes]
constexpr std::size_t kWindow = LineSource::kLongestLine + 2;  // a whole line with its CR LF
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// True for control characters that a transfer over a serial line and DOS put around a text.
bool is_of_transfer(char c) { return c > '\0' && c < ' ' && c != '\t'; }

std::size_t find_in(std::string_view text, char c) {
  const void* at = std::memchr(text.data(), c, text.size());
  return at == nullptr ? text.size()
                       : static_cast<std::size_t>(static_cast<const char*>(at) - text.data());
}

}  // namespace

LineSource::LineSource(ProgramText program) : program_(std::move(program)) {
  buffer_.resize(std::min(kBufferSize, static_cast<std::size_t>(program_.size())));
}

/// Moves what is unread to the front of the buffer and fills the rest from the program.
Expected<void> LineSource::refill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  TWIN_TRY(const std::size_t count,
           program_.copy(taken_, {buffer_.data() + end_, buffer_.size() - end_}));
  taken_ += static_cast<std::int64_t>(count);
  end_ += count;
  return {};
}

void LineSource::seek(const Place& place) noexcept {
  const std::int64_t begin_of_buffer = taken_ - static_cast<std::int64_t>(end_);
  if (place.offset >= begin_of_buffer && place.offset <= taken_) {
    begin_ = static_cast<std::size_t>(place.offset - begin_of_buffer);
  } else {
    begin_ = end_ = 0;
    taken_ = place.offset;
  }
  bytes_ = place.offset;
  line_ = place.line;
}

Expected<std::optional<std::string_view>> LineSource::next() {
  if (taken_ < program_.size() && end_ - begin_ < kWindow) {
    TWIN_CHECK(refill());
  }
  if (line_ == 0 && bytes_ == 0 &&
      std::string_view(buffer_).substr(begin_, end_ - begin_).starts_with(kByteOrderMark)) {
    begin_ += kByteOrderMark.size();
    bytes_ += static_cast<std::int64_t>(kByteOrderMark.size());
  }
  if (begin_ == end_) {
    return std::nullopt;
  }
  ++line_;
  const std::string_view unread(buffer_.data() + begin_, std::min(end_ - begin_, kWindow));
  std::size_t length = find_in(unread, '\n');
  length = find_in(unread.substr(0, length), '\r');
  if (length > kLongestLine) {
    return fail_at(
        static_cast<int>(kLongestLine) + 1,
        fmt::format("the line is longer than {} characters: is this an NC program?", kLongestLine));
  }
  std::size_t taken = std::min(length + 1, unread.size());
  if (unread.substr(length).starts_with("\r\n")) {
    ++taken;
  }
  begin_ += taken;
  bytes_ += static_cast<std::int64_t>(taken);
  stepped_over_ = 0;
  while (stepped_over_ < length && is_of_transfer(unread[stepped_over_])) {
    ++stepped_over_;
  }
  return unread.substr(stepped_over_, length - stepped_over_);
}

}  // namespace twin::gcode
