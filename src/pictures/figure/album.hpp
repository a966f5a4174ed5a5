#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "pictures/figure/figure_script.hpp"
#include "pictures/plot/scripts.hpp"
#include "results/trace/decimator.hpp"

namespace twin::pictures {

/// A picture that was drawn.
struct Picture {
  std::string name;     ///< of its files, as in "fig12_oxalis"
  std::string caption;  ///< one line
};

/// Figures of one folder: collected first, then drawn as PNG and SVG beside their data and scripts.
class Album {
 public:
  /// Makes the folder when it is missing.
  static Expected<Album> open(const std::filesystem::path& folder);

  /// Copies some columns of a CSV file to NAME.csv, thinned so that no peak is lost.
  /// @returns the rows that were kept
  Expected<results::Table> copy_data(const std::filesystem::path& csv, const std::string& name,
                                     std::span<const std::string_view> columns) const;

  /// Writes a table as NAME.csv.
  Expected<void> write_data(const std::string& name, std::span<const std::string_view> columns,
                            const results::Table& table) const;

  /// Adds a figure whose panels read the data of this folder.
  void add(const std::string& name, const std::string& title, const std::vector<Panel>& panels,
           const std::vector<std::string>& legend = {});

  /// Draws what was added.
  /// @returns the pictures by name
  Expected<std::vector<Picture>> draw();

 private:
  explicit Album(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
  std::vector<pictures::Script> scripts_;
  std::vector<Picture> pictures_;
};

}  // namespace twin::pictures
