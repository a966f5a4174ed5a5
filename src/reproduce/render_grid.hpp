#pragma once

#include <string>

#include "reproduce/grid.hpp"

namespace twin::reproduce {

/// For the terminal: aligned columns; "!" behind a ratio that is more than 30 % off.
std::string to_text(const Grid& grid);

/// A heading and a table of GitHub's Markdown.
std::string to_markdown(const Grid& grid);

/// A heading and an HTML table; ratios have the class of their Mark: w10, w20, w30, out.
std::string to_html(const Grid& grid);

/// Any text as HTML shows it.
std::string escape_html(std::string_view text);

}  // namespace twin::reproduce
