#pragma once

#include <string>
#include <vector>

#include "reproduce/reproduction.hpp"

namespace twin::reproduce {

/// How far a ratio is off 1.
enum class Mark { kNone, kWithin10, kWithin20, kWithin30, kOutside };
Mark mark_of(double ours, double published);

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
  std::string note;  ///< what the row does not reach
};

/// A table as text, for the terminal, Markdown and HTML alike.
struct Grid {
  std::string title;
  std::vector<std::string> head;  ///< of the columns, with units
  std::vector<Line> lines;
};

/// A published table with ours below each row: as published and with the defaults, single run and
/// mean, and their ratios to the published figures.
Grid grid_of_table(const Reproduction& reproduction, int table);

/// How many of the figures of Tables 4 and 5 lie within 10, 20 and 30 %.
Grid grid_of_counts(const Reproduction& reproduction);

}  // namespace twin::reproduce
