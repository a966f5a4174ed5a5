#include "gcode/line_source.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "gcode/lexer.hpp"

namespace twin::gcode {
namespace {

constexpr std::size_t kBufferSize = 65536;                     // [bytes]
constexpr std::size_t kWindow = LineSource::kLongestLine + 2;  // a whole line with its CR LF
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string reason(int code) { return std::generic_category().message(code); }

tl::unexpected<Error> file_error(const std::string& path, std::string message) {
  return tl::unexpected<Error>(Error{ErrorCode::kFile, std::move(message), path, 0, 0});
}

std::size_t find_in(std::string_view text, char c) {
  const void* at = std::memchr(text.data(), c, text.size());
  return at == nullptr ? text.size()
                       : static_cast<std::size_t>(static_cast<const char*>(at) - text.data());
}

}  // namespace

Expected<LineSource> LineSource::open(const std::string& path) {
  LineSource source;
  source.file_.reset(std::fopen(path.c_str(), "rb"));
  if (!source.file_) {
    return file_error(path, fmt::format("cannot open the NC program: {}", reason(errno)));
  }
  struct stat status {};
  if (::fstat(::fileno(source.file_.get()), &status) != 0) {
    return file_error(path, fmt::format("cannot read the NC program: {}", reason(errno)));
  }
  if (S_ISDIR(status.st_mode)) {
    return file_error(path, "is a directory; expected an NC program");
  }
  source.size_ = S_ISREG(status.st_mode) ? static_cast<std::int64_t>(status.st_size) : 0;
  source.buffer_.resize(kBufferSize);
  return source;
}

LineSource LineSource::from_text(std::string text) {
  LineSource source;
  source.buffer_ = std::move(text);
  source.end_ = source.buffer_.size();
  source.size_ = static_cast<std::int64_t>(source.end_);
  return source;
}

Expected<void> LineSource::refill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  errno = 0;
  end_ += std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (std::ferror(file_.get()) != 0) {
    return fail(ErrorCode::kFile, fmt::format("cannot read on: {}", reason(errno)));
  }
  if (end_ < buffer_.size()) {
    file_.reset();
  }
  return {};
}

Expected<std::optional<std::string_view>> LineSource::next() {
  if (file_ && end_ - begin_ < kWindow) {
    TWIN_CHECK(refill());
  }
  if (line_ == 0 && begin_ == 0 &&
      std::string_view(buffer_).substr(0, end_).starts_with(kByteOrderMark)) {
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
  return unread.substr(0, length);
}

}  // namespace twin::gcode
