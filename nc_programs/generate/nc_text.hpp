#pragma once

#include <string>

#include "nc_programs/generate/fair_curve.hpp"

namespace twin::programs {

/// A file of nc_programs/ as text.
struct ProgramFile {
  std::string name;  ///< file name
  std::string text;  ///< all of it
};

/// The coordinates as the file will hold them, to 4 decimals [mm].
Point2 round_to_file(const Point2& p);

/// Writer of NC text: one block a line, coordinates with 4 decimals, modal words written once.
class NcText {
 public:
  /// A comment line in parentheses.
  void comment(const std::string& text);
  /// G21 G17 G90 G94, G64, and G01 with the feedrate.
  void start_of_program(double feed_mm_per_min);
  /// A line as given.
  void raw(const std::string& text);
  /// Straight block to p [mm] in the modal motion (G01).
  void line_to(const Point2& p);
  /// Adds M30; the whole text.
  std::string end_of_program();

 private:
  std::string text_;
};

}  // namespace twin::programs
