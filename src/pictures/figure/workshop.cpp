#include "pictures/figure/workshop.hpp"

#include <stdlib.h>

#include <array>
#include <system_error>

#include "core/atomic_file.hpp"

namespace twin::pictures {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> folder_error(const fs::path& folder, const std::error_code& code) {
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, "cannot make this folder: " + code.message(), folder.string(), 0, 0});
}

}  // namespace

Expected<Workshop> Workshop::open(const fs::path& results) {
  std::error_code code;
  fs::create_directories(results, code);
  if (code) {
    return folder_error(results, code);
  }
  std::string folder = (results / ".unfinished_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    return file_error(results, "write into this folder", errno);
  }
  return Workshop(results, folder);
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
