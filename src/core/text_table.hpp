#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace twin {

/// What the reader should know of a field beside its text.
enum class Mark {
  kNone,
  kWithin10,  ///< a ratio that is within 10 % of 1
  kWithin20,
  kWithin30,
  kOutside,   ///< a ratio that is further off
  kDoubtful,  ///< a value that may be chance
};

/// One field of a table, as text.
struct Cell {
  std::string text;
  Mark mark = Mark::kNone;
};

/// A line of a table: what it is about, then a cell for each column.
struct Line {
  std::string row;   ///< "NURBS 3,000"; empty where it is that of the line above
  std::string what;  ///< "published", "ratio", or a text in place of cells
  std::vector<Cell> cells;
  std::string note;  ///< behind the line
};

/// A table as text, for the terminal, Markdown and HTML alike.
struct TextTable {
  std::string title;              ///< on a line of its own; empty leaves it out
  std::vector<std::string> head;  ///< of the columns, with units; empty for lines without cells
  std::vector<Line> lines;
  std::string note_head;  ///< above the notes; empty leaves them out of Markdown
  std::string row_head;   ///< above the names of the rows
};

/// Whether the notes of a table's lines are shown on the terminal.
enum class Notes { kLeftOut, kShown };

/// How a table is laid out on the terminal. Several tables of one layout stand in line.
struct TextLayout {
  std::size_t indent = 0;      ///< blanks in front of each line but the title
  std::size_t row_width = 0;   ///< least width of the names of the rows
  std::size_t cell_width = 5;  ///< least width of a column
  Notes notes = Notes::kLeftOut;
};

/// For the terminal: columns in line, "!" behind a cell marked as outside, "*" behind a doubtful
/// one.
std::string to_text(const TextTable& table, const TextLayout& layout = {});

/// A heading and a table of GitHub's Markdown; bold is what is marked as outside.
std::string to_markdown(const TextTable& table);

/// A heading and an HTML table; cells have the class of their mark: w10, w20, w30, out, doubt.
std::string to_html(const TextTable& table);

/// Any text as a field of a CSV file: between quotes, those of the text doubled.
std::string quote_csv(std::string_view text);

/// Any text as HTML shows it.
std::string escape_html(std::string_view text);

}  // namespace twin
