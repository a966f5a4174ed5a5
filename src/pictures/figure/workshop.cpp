#include "pictures/figure/workshop.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "core/atomic_file.hpp"

namespace twin::pictures {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> folder_error(const fs::path& folder, const std::error_code& code) {
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, "cannot make this folder: " + code.message(), folder.string(), 0, 0});
}

constexpr std::string_view kUnfinished = ".unfinished_";

/// Opens a folder and locks it. @returns a negative descriptor if another one has the lock
Descriptor lock_folder(const fs::path& folder, int waiting) {
  Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (opened.get() >= 0 && ::flock(opened.get(), LOCK_EX | waiting) != 0 && errno == EWOULDBLOCK) {
    return Descriptor();
  }
  return opened;
}

/// Removes the workshops of programs that were killed: those that nobody has locked.
void remove_abandoned(const fs::path& results) {
  std::error_code ignored;
  std::vector<fs::path> abandoned;
  for (const fs::directory_entry& entry : fs::directory_iterator(results, ignored)) {
    if (entry.path().filename().string().starts_with(kUnfinished) &&
        lock_folder(entry.path(), LOCK_NB).get() >= 0) {
      abandoned.push_back(entry.path());
    }
  }
  for (const fs::path& folder : abandoned) {
    fs::remove_all(folder, ignored);
  }
}

}  // namespace

Expected<Workshop> Workshop::open(const fs::path& results) {
  std::error_code code;
  fs::create_directories(results, code);
  if (code) {
    return folder_error(results, code);
  }
  // Nobody removes a workshop between its making and its locking, because that takes this lock too.
  const Descriptor alone = lock_folder(results, 0);
  remove_abandoned(results);
  std::string folder = (results / (std::string(kUnfinished) + "XXXXXX")).string();
  if (mkdtemp(folder.data()) == nullptr) {
    return file_error(results, "write into this folder", errno);
  }
  return Workshop(results, folder, lock_folder(folder, LOCK_NB));
}

Workshop::~Workshop() {
  if (!folder_.empty()) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
}

Expected<void> Workshop::deliver_one(const std::string& name) const {
  const fs::path target = results_ / name;
  std::error_code code;
  if (fs::is_directory(folder_ / name, code) && fs::exists(target, code)) {
    fs::rename(target, folder_ / (name + ".older"), code);  // a rename replaces no full folder
  }
  code.clear();
  fs::rename(folder_ / name, target, code);
  if (code) {
    return file_error(target, "write", code.value());
  }
  return {};
}

Expected<std::vector<std::string>> Workshop::write(std::span<const NamedText> texts) const {
  std::vector<std::string> names;
  for (const auto& [name, text] : texts) {
    TWIN_CHECK(write_whole_file(folder_ / name, text));
    names.emplace_back(name);
  }
  return names;
}

Expected<void> Workshop::deliver(std::span<const std::string> names) const {
  for (const std::string& name : names) {
    TWIN_CHECK(deliver_one(name));
  }
  sync_folder(results_);
  return {};
}

Expected<void> Workshop::deliver_study(std::span<const NamedText> texts, Drawing drawing) const {
  TWIN_TRY(std::vector<std::string> names, write(texts));
  const std::array<std::string, 1> folder{pictures().filename().string()};
  if (drawing == Drawing::kDrawn) {
    names.insert(names.begin(), folder.front());
  } else {
    discard_older(folder);
  }
  return deliver(names);
}

void Workshop::discard_older(std::span<const std::string> names) const {
  std::error_code ignored;
  for (const std::string& name : names) {
    fs::rename(results_ / name, folder_ / (name + ".older"), ignored);
  }
}

}  // namespace twin::pictures
