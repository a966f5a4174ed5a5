#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "core/must_finish.hpp"

namespace twin {
namespace {

constexpr std::size_t kBufferBytes = 64UL * 1024;

constexpr int kTries = 100;  // to lock the file that has a name, while others rename it

tl::unexpected<Error> in_the_way(const std::filesystem::path& file, std::string_view what) {
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, fmt::format("cannot write: {}", what), file.string(), 0, 0});
}

/// Opens a file for writing, as it is, without waiting for anybody. @returns -1 and errno if not
int open_as_it_is(const std::filesystem::path& file) {
  constexpr int flags = O_WRONLY | O_CLOEXEC | O_NONBLOCK;
  const int descriptor = ::open(file.c_str(), flags | O_CREAT | O_NOFOLLOW, 0666);
  struct stat status {};
  if (descriptor < 0 && errno == ELOOP && ::stat(file.c_str(), &status) == 0 &&
      S_ISCHR(status.st_mode)) {
    return ::open(file.c_str(), flags);
  }
  return descriptor;
}

/// What an open file is that must not be written to; empty for a file or a device.
std::string_view foreign_kind(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || S_ISREG(status.st_mode) || S_ISCHR(status.st_mode)) {
    return {};
  }
  return S_ISFIFO(status.st_mode) ? "there is a FIFO of this name"
                                  : "there is something else than a file of this name";
}

/// Whether a name still means an open file.
bool is_named(int descriptor, const std::filesystem::path& name) {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && ::stat(name.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// Opens a temporary file and locks it. File systems without locks are no obstacle.
Expected<Descriptor> open_and_lock(const std::filesystem::path& temporary) {
  for (int i = 0; i < kTries; ++i) {
    Descriptor descriptor(open_as_it_is(temporary));
    if (descriptor.get() < 0) {
      const int reason = errno;
      return reason == ELOOP   ? in_the_way(temporary, "there is a symbolic link of this name")
             : reason == ENXIO ? in_the_way(temporary, "there is a FIFO of this name")
                               : file_error(temporary, "open for writing", reason);
    }
    if (const std::string_view kind = foreign_kind(descriptor.get()); !kind.empty()) {
      return in_the_way(temporary, kind);
    }
    if (::flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      break;
    }
    // Another process may have given this file its final name since it was opened here.
    if (is_named(descriptor.get(), temporary)) {
      return descriptor;
    }
  }
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, "another run is writing this file", temporary.string(), 0, 0});
}

/// Waits until the bytes of a file are on the disk. What has no disk behind it needs none.
/// @returns 0 or errno
int sync(int descriptor) {
  while (::fsync(descriptor) != 0) {
    if (errno != EINTR) {
      return errno == EINVAL || errno == EROFS ? 0 : errno;
    }
  }
  return 0;
}

}  // namespace

tl::unexpected<Error> file_error(const std::filesystem::path& file, std::string_view action,
                                 int errno_value) {
  const std::string reason = std::generic_category().message(errno_value);
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, fmt::format("cannot {}: {}", action, reason), file.string(), 0, 0});
}

Expected<AtomicFile> AtomicFile::create(std::filesystem::path target,
                                        std::filesystem::path temporary, OnAbandon on_abandon,
                                        Durability durability) {
  std::error_code ignored;
  const auto existing = std::filesystem::status(target, ignored);
  if (std::filesystem::exists(existing) && !std::filesystem::is_regular_file(existing)) {
    return tl::unexpected<Error>(
        Error{ErrorCode::kFile, "cannot write: there is something else than a file of this name",
              target.string(), 0, 0});
  }
  AtomicFile file;
  TWIN_TRY(file.descriptor_, open_and_lock(temporary));
  file.target_ = std::move(target);
  file.temporary_ = std::move(temporary);
  file.on_abandon_ = on_abandon;
  file.durability_ = durability;
  if (on_abandon == OnAbandon::kRemove) {
    file.listed_.emplace(file.temporary_);
  }
  if (::ftruncate(file.descriptor_.get(), 0) != 0 && errno != EINVAL) {
    return file_error(file.temporary_, "write", errno);
  }
  file.buffer_.reserve(2 * kBufferBytes);
  return file;
}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this != &other) {
    abandon();
    target_ = std::move(other.target_);
    temporary_ = std::move(other.temporary_);
    listed_ = std::exchange(other.listed_, std::nullopt);
    on_abandon_ = other.on_abandon_;
    durability_ = other.durability_;
    descriptor_ = std::move(other.descriptor_);
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
  failure_ = failure_ != 0 ? failure_ : write_all(descriptor_.get(), buffer_);
  buffer_.clear();
  if (failure_ != 0) {
    return file_error(target_, "write", failure_);
  }
  return {};
}

Expected<void> AtomicFile::commit() {
  if (descriptor_.get() < 0) {
    return file_error(target_, "write", failure_ != 0 ? failure_ : EBADF);
  }
  const MustFinish finish;
  if (auto flushed = flush(); !flushed) {
    abandon();
    return flushed;
  }
  if (durability_ == Durability::kSynced) {
    failure_ = sync(descriptor_.get());
  }
  // Renamed before it is closed, that is while it is still locked: nobody else can empty it in
  // between.
  if (failure_ == 0 && std::rename(temporary_.c_str(), target_.c_str()) != 0) {
    failure_ = errno;
  }
  if (failure_ != 0) {
    const int reason = failure_;
    abandon();
    return file_error(target_, "write", reason);
  }
  listed_.reset();
  if (durability_ == Durability::kSynced) {
    sync_folder(target_.parent_path());
  }
  if (::close(descriptor_.release()) != 0) {
    failure_ = errno;
    return file_error(target_, "write", failure_);
  }
  return {};
}

void AtomicFile::abandon() noexcept {
  if (descriptor_.get() < 0) {
    return;
  }
  if (on_abandon_ == OnAbandon::kRemove) {
    ::unlink(temporary_.c_str());
  } else if (failure_ == 0) {
    static_cast<void>(flush());
  }
  listed_.reset();
  descriptor_ = Descriptor();
}

std::filesystem::path temporary_of(std::filesystem::path file) { return file += ".tmp"; }

Expected<void> write_whole_file(const std::filesystem::path& file, std::string_view content,
                                Durability durability) {
  return AtomicFile::create(file, temporary_of(file), OnAbandon::kRemove, durability)
      .and_then([&](AtomicFile&& atomic) {
        return atomic.write(content).and_then([&] { return atomic.commit(); });
      });
}

Expected<std::string> read_whole_file(const std::filesystem::path& file) {
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (opened.get() < 0) {
    return file_error(file, "read", errno);
  }
  std::string content;
  std::array<char, 65536> piece;
  for (;;) {
    const ssize_t count = ::read(opened.get(), piece.data(), piece.size());
    if (count == 0) {
      return content;
    }
    if (count > 0) {
      content.append(piece.data(), static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return file_error(file, "read", errno);
    }
  }
}

void sync_folder(const std::filesystem::path& folder) noexcept {
  const Descriptor opened(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.get() >= 0) {
    static_cast<void>(sync(opened.get()));
  }
}

}  // namespace twin
