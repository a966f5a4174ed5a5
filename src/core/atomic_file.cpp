#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace twin {
namespace {

constexpr std::size_t kBufferBytes = 64UL * 1024;

/// Takes the lock of an open file. File systems without locks are no obstacle. @returns 0 or errno
int lock(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    return 0;
  }
  return errno == EWOULDBLOCK ? EWOULDBLOCK : 0;
}

}  // namespace

tl::unexpected<Error> file_error(const std::filesystem::path& file, std::string_view action,
                                 int errno_value) {
  const std::string reason = std::generic_category().message(errno_value);
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, fmt::format("cannot {}: {}", action, reason), file.string(), 0, 0});
}

Expected<AtomicFile> AtomicFile::create(std::filesystem::path target,
                                        std::filesystem::path temporary, OnAbandon on_abandon) {
  std::error_code ignored;
  const auto existing = std::filesystem::status(target, ignored);
  if (std::filesystem::exists(existing) && !std::filesystem::is_regular_file(existing)) {
    return tl::unexpected<Error>(
        Error{ErrorCode::kFile, "cannot write: there is something else than a file of this name",
              target.string(), 0, 0});
  }
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return file_error(temporary, "open for writing", errno);
  }
  if (lock(descriptor) != 0) {
    ::close(descriptor);
    return tl::unexpected<Error>(
        Error{ErrorCode::kFile, "another run is writing this file", temporary.string(), 0, 0});
  }
  AtomicFile file;
  file.target_ = std::move(target);
  file.temporary_ = std::move(temporary);
  file.on_abandon_ = on_abandon;
  file.descriptor_ = descriptor;
  if (::ftruncate(descriptor, 0) != 0 && errno != EINVAL) {
    return file_error(file.temporary_, "write", errno);
  }
  file.buffer_.reserve(2 * kBufferBytes);
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      on_abandon_(other.on_abandon_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      failure_(other.failure_),
      buffer_(std::move(other.buffer_)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this != &other) {
    abandon();
    target_ = std::move(other.target_);
    temporary_ = std::move(other.temporary_);
    on_abandon_ = other.on_abandon_;
    descriptor_ = std::exchange(other.descriptor_, -1);
    failure_ = other.failure_;
    buffer_ = std::move(other.buffer_);
  }
  return *this;
}

AtomicFile::~AtomicFile() { abandon(); }

Expected<void> AtomicFile::write(std::string_view bytes) {
  if (failure_ != 0) {
    return file_error(target_, "write", failure_);
  }
  buffer_.append(bytes);
  return buffer_.size() < kBufferBytes ? Expected<void>{} : flush();
}

Expected<void> AtomicFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty() && failure_ == 0) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written > 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0 || errno != EINTR) {
      failure_ = written == 0 ? EIO : errno;
    }
  }
  buffer_.clear();
  if (failure_ != 0) {
    return file_error(target_, "write", failure_);
  }
  return {};
}

Expected<void> AtomicFile::commit() {
  if (descriptor_ < 0) {
    return file_error(target_, "write", failure_ != 0 ? failure_ : EBADF);
  }
  if (auto flushed = flush(); !flushed) {
    abandon();
    return flushed;
  }
  // Renamed before it is closed, that is while it is still locked: nobody else can empty it in
  // between.
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int reason = errno;
    abandon();
    return file_error(target_, "write", reason);
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) {
    failure_ = errno;
    return file_error(target_, "write", failure_);
  }
  return {};
}

void AtomicFile::abandon() noexcept {
  if (descriptor_ < 0) {
    return;
  }
  if (on_abandon_ == OnAbandon::kRemove) {
    ::unlink(temporary_.c_str());
  } else if (failure_ == 0) {
    static_cast<void>(flush());
  }
  ::close(std::exchange(descriptor_, -1));
}

Expected<void> write_whole_file(const std::filesystem::path& file, std::string_view content) {
  std::filesystem::path temporary = file;
  temporary += ".tmp";
  return AtomicFile::create(file, std::move(temporary)).and_then([&](AtomicFile&& atomic) {
    return atomic.write(content).and_then([&] { return atomic.commit(); });
  });
}

}  // namespace twin
