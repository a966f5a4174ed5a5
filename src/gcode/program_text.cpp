#include "gcode/program_text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/descriptor.hpp"
#include "core/sha256.hpp"
#include "core/stop_wish.hpp"
#include "gcode/text/line_source.hpp"

namespace twin::gcode {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = std::size_t{1} << 18;          // read at a time [bytes]
constexpr std::int64_t kLongestPipe = std::int64_t{1} << 32;  // [bytes]
constexpr int kLookAtStop = 50;                               // every so often [ms]

tl::unexpected<Error> named(const fs::path& file, ErrorCode code, std::string message) {
  return tl::unexpected(Error{code, std::move(message), file.string(), 0, 0});
}

bool is_standard_input(const fs::path& path) { return path == "-" || path == "/dev/stdin"; }

/// What tells one state of a file from another.
struct FileState {
  dev_t device = 0;
  ino_t inode = 0;
  off_t size = 0;
  timespec written{};

  explicit FileState(const struct stat& status)
      : device(status.st_dev),
        inode(status.st_ino),
        size(status.st_size),
        written(status.st_mtim) {}
  bool operator==(const FileState& other) const noexcept {
    return device == other.device && inode == other.inode && size == other.size &&
           written.tv_sec == other.written.tv_sec && written.tv_nsec == other.written.tv_nsec;
  }
};

constexpr const char* kNameCharacters = "abcdefghijklmnopqrstuvwxyzO0123456789-_";

/// The file of a subprogram in the first folder that has one. A link may not lead out of the folder.
Expected<std::optional<fs::path>> find_subprogram(const std::vector<fs::path>& folders,
                                                  const std::string& name) {
  for (const fs::path& folder : folders) {
    for (const char* ending : {".ngc", ".nc", ".NGC", ".NC"}) {
      std::error_code code;
      const fs::path file = folder / (name + ending);
      if (!fs::exists(file, code)) {
        continue;
      }
      const fs::path real_folder = fs::canonical(folder, code);
      const fs::path real_file = code ? fs::path() : fs::canonical(file, code);
      if (code || real_file.parent_path() != real_folder) {
        return named(file, ErrorCode::kFile,
                     "is a link out of its folder: expected the subprogram itself");
      }
      return file;
    }
  }
  return std::nullopt;
}

/// Makes a file without a name in a folder, or where that is not there, in the nearest folder above
/// it. @returns its descriptor, or -1 and errno
int nameless_file(fs::path folder) {
  std::error_code code;
  if (folder.empty()) {
    folder = fs::temp_directory_path(code);
  }
  while (!folder.empty() && !fs::is_directory(folder, code) && folder.has_relative_path()) {
    folder = folder.parent_path();
  }
  folder = folder.empty() ? fs::path(".") : folder;
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != ENOENT)) {
    return descriptor;
  }
  std::string name = (folder / ".twin-program-XXXXXX").string();
  const int named_file = ::mkostemp(name.data(), O_CLOEXEC);
  if (named_file >= 0) {
    ::unlink(name.c_str());
  }
  return named_file;
}

/// Whether a text has a line that no reading gets past, so that what follows need not be copied. It
/// keeps what is no program, as /dev/zero, from being read for ever.
class LongLineWatch {
 public:
  bool add(std::string_view bytes) {
    for (const char c : bytes) {
      length_ = c == '\n' || c == '\r' ? 0 : length_ + 1;
      if (length_ > LineSource::kLongestLine + 2) {
        return true;
      }
    }
    return false;
  }

 private:
  std::size_t length_ = 0;
};

/// The bytes of a program, and where they are.
struct Bytes {
  std::string text;   // all, or none where they are in the copy
  Descriptor copy{};  // a file without a name
  std::int64_t size = 0;
  std::string sha256;
};

/// Copies a program from an open file.
class Copying {
 public:
  /// @param file  for messages
  Copying(const fs::path& file, const ProgramText::Reading& reading)
      : file_(file), reading_(reading) {}

  Expected<Bytes> run(int from, bool is_regular) {
    std::string piece(kPiece, '\0');
    LongLineWatch watch;
    for (bool goes_on = true; goes_on;) {
      TWIN_TRY(const std::size_t count, next(from, piece));
      const std::string_view bytes(piece.data(), count);
      TWIN_CHECK(keep(bytes));
      goes_on = count > 0 && !watch.add(bytes);
      if (!is_regular && done_.size > kLongestPipe) {
        return named(file_, ErrorCode::kFile,
                     "the program does not end: 4 GiB were read; expected an NC program");
      }
    }
    done_.sha256 = hash_.finish();
    return std::move(done_);
  }

 private:
  /// The next bytes as soon as there are any; none at the end.
  Expected<std::size_t> next(int from, std::string& piece) {
    for (;;) {
      TWIN_CHECK(check_wish(reading_.stop, "interrupted: nothing has moved"));
      pollfd ready{from, POLLIN, 0};
      const int events = ::poll(&ready, 1, kLookAtStop);
      if (events == 0 || (events < 0 && errno == EINTR)) {
        continue;
      }
      const ssize_t count = ::read(from, piece.data(), piece.size());
      if (count >= 0) {
        return static_cast<std::size_t>(count);
      }
      if (errno != EINTR && errno != EAGAIN) {
        return file_error(file_, "read the NC program", errno);
      }
    }
  }

  Expected<void> keep(std::string_view bytes) {
    hash_.add(bytes);
    done_.size += static_cast<std::int64_t>(bytes.size());
    if (done_.copy.get() < 0 && done_.text.size() + bytes.size() <= ProgramText::kInMemory) {
      done_.text.append(bytes);
      return {};
    }
    std::string before;
    if (done_.copy.get() < 0) {
      done_.copy = Descriptor(nameless_file(reading_.folder));
      if (done_.copy.get() < 0) {
        return file_error(file_, "keep a copy of the NC program", errno);
      }
      before = std::exchange(done_.text, {});
    }
    int code = write_all(done_.copy.get(), before);
    code = code != 0 ? code : write_all(done_.copy.get(), bytes);
    return code == 0 ? Expected<void>() : file_error(file_, "keep a copy of the NC program", code);
  }

  const fs::path& file_;
  const ProgramText::Reading& reading_;
  Bytes done_;
  Sha256 hash_;
};

}  // namespace

struct ProgramText::Data {
  fs::path file;
  Bytes bytes;
  std::optional<FileState> state;  // of a regular file
  std::vector<fs::path> folders;   // of subprograms
  fs::path folder_of_copies;
  mutable std::mutex guard;  // of what follows
  mutable std::map<std::string, std::optional<ProgramText>> subprograms;
};

Expected<ProgramText> ProgramText::read(const fs::path& path, const Reading& reading) {
  auto data = std::make_shared<Data>();
  data->file = path == "-" ? fs::path("/dev/stdin") : path;
  // Without O_NONBLOCK the opening of a FIFO would wait for its writer, deaf to the wish to stop.
  const Descriptor from(is_standard_input(path)
                            ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                            : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (from.get() < 0) {
    return file_error(path, "open the NC program", errno);
  }
  struct stat before {};
  if (::fstat(from.get(), &before) != 0) {
    return file_error(path, "read the NC program", errno);
  }
  if (S_ISDIR(before.st_mode)) {
    return named(path, ErrorCode::kFile, "is a directory; expected an NC program");
  }
  const bool is_regular = S_ISREG(before.st_mode);
  TWIN_TRY(data->bytes, Copying(data->file, reading).run(from.get(), is_regular));
  struct stat after {};
  if (is_regular && !is_standard_input(path)) {
    data->state = FileState(before);
    data->folders.push_back(path.has_parent_path() ? path.parent_path() : fs::path("."));
    if (::fstat(from.get(), &after) != 0 || FileState(after) != *data->state) {
      return named(path, ErrorCode::kFile,
                   "the NC program changed while it was read; nothing has moved");
    }
  }
  data->folder_of_copies = reading.folder;
  data->folders.insert(data->folders.end(), reading.subprogram_folders.begin(),
                       reading.subprogram_folders.end());
  return ProgramText(std::move(data));
}

ProgramText::ProgramText() : data_(std::make_shared<Data>()) {}

ProgramText ProgramText::from_text(std::string text, fs::path name) {
  auto data = std::make_shared<Data>();
  data->bytes.sha256 = twin::sha256(text);
  data->bytes.size = static_cast<std::int64_t>(text.size());
  data->bytes.text = std::move(text);
  data->file = std::move(name);
  return ProgramText(std::move(data));
}

const fs::path& ProgramText::file() const noexcept { return data_->file; }
std::int64_t ProgramText::size() const noexcept { return data_->bytes.size; }
const std::string& ProgramText::sha256() const noexcept { return data_->bytes.sha256; }

Expected<std::size_t> ProgramText::copy(std::int64_t offset, std::span<char> to) const {
  if (data_->bytes.copy.get() < 0) {
    const std::string_view rest =
        std::string_view(data_->bytes.text)
            .substr(static_cast<std::size_t>(std::min(offset, data_->bytes.size)), to.size());
    std::copy(rest.begin(), rest.end(), to.begin());
    return rest.size();
  }
  std::size_t done = 0;
  while (done < to.size()) {
    const ssize_t count = ::pread(data_->bytes.copy.get(), to.data() + done, to.size() - done,
                                  static_cast<off_t>(offset) + static_cast<off_t>(done));
    if (count < 0 && errno != EINTR) {
      return file_error(data_->file, "read on in the copy of the NC program", errno);
    }
    if (count == 0) {
      break;
    }
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return done;
}

bool ProgramText::has_changed() const {
  struct stat now {};
  if (data_->state && (::stat(data_->file.c_str(), &now) != 0 || FileState(now) != *data_->state)) {
    return true;
  }
  const std::vector<ProgramText> others = subprograms();
  return std::any_of(others.begin(), others.end(),
                     [](const ProgramText& other) { return other.has_changed(); });
}

Expected<std::optional<ProgramText>> ProgramText::subprogram(const std::string& name) const {
  if (name.empty() || name.find_first_not_of(kNameCharacters) != std::string::npos) {
    return std::nullopt;
  }
  const std::lock_guard lock(data_->guard);
  if (const auto known = data_->subprograms.find(name); known != data_->subprograms.end()) {
    return known->second;
  }
  if (data_->subprograms.size() == kMostSubprograms) {
    return named(data_->file, ErrorCode::kProgram,
                 fmt::format("calls more than {} files of subprograms", kMostSubprograms));
  }
  std::optional<ProgramText> found;
  TWIN_TRY(const std::optional<fs::path> file, find_subprogram(data_->folders, name));
  if (file) {
    TWIN_TRY(found, read(*file, {.folder = data_->folder_of_copies}));
  }
  data_->subprograms.emplace(name, found);
  return found;
}

std::vector<ProgramText> ProgramText::subprograms() const {
  const std::lock_guard lock(data_->guard);
  std::vector<ProgramText> texts;
  for (const auto& [name, text] : data_->subprograms) {
    if (text) {
      texts.push_back(*text);
    }
  }
  return texts;
}

}  // namespace twin::gcode
