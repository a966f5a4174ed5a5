#pragma once

#include "pictures/video/image.hpp"

namespace twin::pictures::video {

/// Colours for contour errors from 0 to a round largest value: dark blue over purple and red to
/// orange.
///
/// The colours are the darker four fifths of the map "plasma" of matplotlib: lightness rises
/// evenly, so that the scale also reads without colour, and even its bright end stands out on a
/// light plate.
class ColourScale {
 public:
  /// @param largest_error_um  largest error that will be shown [um]; the end of the scale is the
  /// next round number
  explicit ColourScale(double largest_error_um);

  double end_um() const noexcept { return end_um_; }  ///< error at the bright end [um]
  Colour colour(double error_um) const noexcept;  ///< colour of an error [um]; clamped to the scale

 private:
  double end_um_;
};

/// The smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not below the value; 1 for
/// 0.
double round_up(double value);

}  // namespace twin::pictures::video
