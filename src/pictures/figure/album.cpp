#include "pictures/figure/album.hpp"

#include <algorithm>
#include <utility>

#include "core/atomic_file.hpp"
#include "pictures/plot/gnuplot.hpp"

namespace twin::pictures {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostRows = 12000;  // of a figure's data

}  // namespace

Expected<Album> Album::open(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) {
    return file_error(folder, "make this folder", code.value());
  }
  return Album(folder);
}

Expected<results::Table> Album::copy_data(const fs::path& csv, const std::string& name,
                                          std::span<const std::string_view> columns) const {
  TWIN_TRY(results::Table table, results::load_decimated(csv, columns, kMostRows));
  TWIN_CHECK(write_data(name, columns, table));
  return table;
}

Expected<void> Album::write_data(const std::string& name, std::span<const std::string_view> columns,
                                 const results::Table& table) const {
  return write_table(folder_, name, columns, table);
}

void Album::add(const std::string& name, const std::string& title, const std::vector<Panel>& panels,
                const std::vector<std::string>& legend) {
  scripts_.push_back({name, figure_script(name, title, panels, legend)});
  pictures_.push_back({name, title});
}

Expected<std::vector<Picture>> Album::draw() {
  TWIN_CHECK(pictures::draw(folder_, scripts_));
  std::ranges::sort(pictures_, {}, &Picture::name);
  return std::move(pictures_);
}

}  // namespace twin::pictures
