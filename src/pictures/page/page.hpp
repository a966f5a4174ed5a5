#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "pictures/page/page_rows.hpp"

/// A run, or several side by side, as one HTML file that needs no network.
namespace twin::pictures {

/// The NC program of a run, as far as a page shows it.
struct PageProgram {
  std::string text;           ///< its lines; empty if it is too long to be shown
  std::vector<Vec2> outline;  ///< programmed path seen along Z; not a number lifts it [mm]
  std::vector<std::int64_t> rapid_lines;  ///< lines of G00
};

/// A run on a page.
struct PageRun {
  std::string name;         ///< by which it is told from the others
  std::string summary;      ///< text of its summary.json
  bool is_partial = false;  ///< it ended early
  bool is_live = false;     ///< it is under way: the page asks for its rows
  PageRows rows;
  std::optional<PageProgram> program;
  std::string note;    ///< why there is no program; may be empty
  std::string shadow;  ///< text of its shadow.json; empty: it had no shadow
};

/// The text of the page.
Expected<std::string> page_text(std::span<const PageRun> runs, const std::string& title);

}  // namespace twin::pictures
