#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace twin::pictures {

/// One of the diagrams below each other in a figure.
struct Panel {
  std::string caption;   ///< "(a) 3,000 mm/min"
  std::string x_label;   ///< with its unit
  std::string y_label;   ///< with its unit
  std::string settings;  ///< gnuplot commands of this panel, each with its line end
  std::string plot;      ///< what stands behind "plot"
  int height = 260;      ///< of the diagram itself [pixels of the PNG]
};

/// Width of a picture: a column of the paper, 8.5 cm, at 300 pixels an inch.
inline constexpr int kFigureWidth = 1004;
/// Width of the diagrams in it [pixels].
inline constexpr int kPanelWidth = 810;

/// Colour of a line style from 1 on; those beyond the last begin again.
std::string_view colour(std::size_t style);

/// The gnuplot script that draws NAME.png and NAME.svg. Texts are 7 to 8 points high when the
/// picture is as wide as a column.
///
/// @param legend  names of line styles 1, 2, ... below the title; empty for none
std::string figure_script(const std::string& name, const std::string& title,
                          const std::vector<Panel>& panels,
                          const std::vector<std::string>& legend = {});

}  // namespace twin::pictures
