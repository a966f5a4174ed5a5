#include "pictures/figure/album.hpp"

#include <algorithm>
#include <utility>

#include "core/atomic_file.hpp"
#include "pictures/plot/draw.hpp"
#include "results/trace/csv_file.hpp"

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
  auto table = results::load_decimated(csv, columns, kMostRows);
  if (!table) {
    return table;
  }
  if (auto written = write_data(name, columns, *table); !written) {
    return tl::unexpected(std::move(written.error()));
  }
  return table;
}

Expected<void> Album::write_data(const std::string& name, std::span<const std::string_view> columns,
                                 const results::Table& table) const {
  auto file =
      results::CsvFile::create(folder_ / (name + ".csv"), folder_ / (name + ".csv.tmp"), columns);
  if (!file) {
    return tl::unexpected(std::move(file.error()));
  }
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (auto written = file->write(table.row(i)); !written) {
      return written;
    }
  }
  return file->commit();
}

void Album::add(const std::string& name, const std::string& title, const std::vector<Panel>& panels,
                const std::vector<std::string>& legend) {
  scripts_.push_back({name, figure_script(name, title, panels, legend)});
  pictures_.push_back({name, title});
}

Expected<std::vector<Picture>> Album::draw() {
  if (auto drawn = pictures::draw(folder_, scripts_); !drawn) {
    return tl::unexpected(std::move(drawn.error()));
  }
  std::ranges::sort(pictures_, {}, &Picture::name);
  return std::move(pictures_);
}

}  // namespace twin::pictures
