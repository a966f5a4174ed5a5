#include "pictures/plot/draw.hpp"

#include <string>
#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "pictures/plot/gnuplot.hpp"

namespace twin::pictures {
namespace {

namespace fs = std::filesystem;

/// A picture that gnuplot left out although it said nothing, as on a full disk.
Expected<void> check_pictures(const std::vector<fs::path>& pictures) {
  for (const fs::path& picture : pictures) {
    std::error_code error;
    if (fs::file_size(picture, error) == 0 || error) {
      return tl::unexpected<Error>(
          Error{ErrorCode::kFile, "gnuplot did not write this picture", picture.string(), 0, 0});
    }
  }
  return {};
}

void remove_all(const std::vector<fs::path>& files) {
  std::error_code ignored;
  for (const fs::path& file : files) {
    fs::remove(file, ignored);
  }
}

}  // namespace

Expected<std::vector<fs::path>> draw(const fs::path& folder, std::span<const Script> scripts) {
  std::vector<fs::path> pictures;
  std::vector<std::string> names;
  for (const Script& script : scripts) {
    names.push_back(script.name + ".gp");
    pictures.push_back(folder / (script.name + ".png"));
    pictures.push_back(folder / (script.name + ".svg"));
    TWIN_CHECK(write_whole_file(folder / names.back(), script.text));
  }
  remove_all(pictures);  // no older picture may pass for one of this run
  auto drawn = run_gnuplot(folder, names).and_then([&] { return check_pictures(pictures); });
  if (!drawn) {
    remove_all(pictures);
    return tl::unexpected(std::move(drawn.error()));
  }
  return pictures;
}

}  // namespace twin::pictures
