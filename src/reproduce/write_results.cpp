#include "reproduce/write_results.hpp"

#include <unistd.h>

#include <system_error>

#include "core/atomic_file.hpp"
#include "reproduce/files.hpp"
#include "reproduce/paper_figures.hpp"

namespace twin::reproduce {
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

Expected<void> Workshop::deliver(const std::string& name) const {
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

Expected<void> write_results(const Reproduction& reproduction, const Workshop& workshop,
                             bool draws) {
  std::vector<Picture> pictures;
  std::vector<std::string> names{"tables.csv", "reproduce.json", "tables.md", "index.html"};
  if (draws) {
    auto drawn = draw_figures(reproduction, workshop.folder() / "figures");
    if (!drawn) {
      return tl::unexpected(std::move(drawn.error()));
    }
    pictures = std::move(*drawn);
    names.insert(names.begin(), "figures");
  }
  const std::string texts[] = {csv_text(reproduction), json_text(reproduction),
                               markdown_text(reproduction), page_text(reproduction, pictures)};
  for (std::size_t i = 0; i < std::size(texts); ++i) {
    const std::string& name = names[names.size() - std::size(texts) + i];
    if (auto written = write_whole_file(workshop.folder() / name, texts[i]); !written) {
      return written;
    }
  }
  for (const std::string& name : names) {
    if (auto delivered = workshop.deliver(name); !delivered) {
      return delivered;
    }
  }
  return {};
}

}  // namespace twin::reproduce
