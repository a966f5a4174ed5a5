#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "pictures/figure/paper.hpp"
#include "pictures/plot/scripts.hpp"
#include "results/trace/decimator.hpp"

/// The files of a figure in its folder: its data, its script, and what gnuplot makes of both.
namespace twin::pictures {

/// Writes the data of a figure as NAME.csv into a folder.
Expected<void> write_table(const std::filesystem::path& folder, const std::string& name,
                           std::span<const std::string_view> columns, const results::Table& table);

/// Writes each script as NAME.gp into a folder and lets gnuplot run it there, two at a time; a
/// script makes NAME.png and NAME.svg, for a paper NAME.pdf too.
///
/// Gnuplot is started directly, without a shell, so that no name needs quoting, and is killed when
/// this program ends. It draws in a folder of its own; pictures get their place when all of them are
/// whole.
///
/// @returns the pictures; after an error there are none, an older run's neither. When gnuplot is
///          missing or fails, the Error has the first line of its complaint
Expected<std::vector<std::filesystem::path>> draw(const std::filesystem::path& folder,
                                                  std::span<const Script> scripts,
                                                  Paper paper = Paper::kNone);

}  // namespace twin::pictures
