#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Tables, figures and folders of commands that are about several runs.
namespace twin {

/// How far a ratio is off 1: within 10, 20, 30 %, or further.
enum class Mark { kNone, kWithin10, kWithin20, kWithin30, kOutside };

/// One field of a table, as text.
struct Cell {
  std::string text;
  Mark mark = Mark::kNone;
};

/// A line of a table: what it is about, then a cell for each column.
struct Line {
  std::string row;   ///< "NURBS 3,000"; empty where it is that of the line above
  std::string what;  ///< "published", "ratio"
  std::vector<Cell> cells;
  std::string note;  ///< behind the line, in Markdown and HTML
};

/// A table as text, for the terminal, Markdown and HTML alike.
struct TextTable {
  std::string title;
  std::vector<std::string> head;  ///< of the columns, with units
  std::vector<Line> lines;
  std::string note_head;  ///< above the notes; empty leaves them out
};

/// For the terminal: aligned columns, "!" behind what is marked as outside.
std::string to_text(const TextTable& table);

/// A heading and a table of GitHub's Markdown; bold is what is marked as outside.
std::string to_markdown(const TextTable& table);

/// A heading and an HTML table; cells have the class of their mark: w10, w20, w30, out.
std::string to_html(const TextTable& table);

/// Any text as HTML shows it.
std::string escape_html(std::string_view text);

}  // namespace twin
