#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

/// The tables and pictures of Wang and Yau's paper beside ours.
namespace twin::studies::reproduce {

/// One row of a published table, and the run that answers it.
struct PublishedRow {
  int table = 0;
  std::string program;                ///< "oxalis"
  std::string interpolator;           ///< "nurbs", "bezier"
  double feedrate_mm_per_min = 0.0;   ///< programmed
  std::vector<std::string> settings;  ///< section.key=value: the paper's variants for this row
  std::vector<double> values;         ///< in the order of columns_of(table), in their units

  /// "NURBS 3,000", without the program.
  std::string short_name() const;
  /// "oxalis, NURBS 3,000 mm/min"
  std::string name() const;
};

/// Everything that is taken from the paper.
struct Published {
  std::string source;
  std::vector<PublishedRow> rows;  ///< by table, as printed
};

/// Reads the text of a data file; every column of every row must be there.
Expected<Published> parse_published(std::string_view toml);

/// The data file of this folder, which is part of the program.
Expected<Published> published();

}  // namespace twin::studies::reproduce
