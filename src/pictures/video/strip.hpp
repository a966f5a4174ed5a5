#pragma once

#include <vector>

#include "pictures/video/font.hpp"
#include "pictures/video/history.hpp"
#include "pictures/video/image.hpp"

namespace twin::pictures::video {

/// Curves of feedrate and contour error under the picture: what is still to come is pale, a line
/// stands at the present.
class Strip {
 public:
  /// @param width,height  of the strip [pixels]
  /// @param duration      machining time [s]
  Strip(const History& history, double duration, double error_end_um, bool has_error, int width,
        int height);

  /// Draws it at the lower edge of a frame. @param t  the present [s]
  void draw(Image& frame, const Font& font, double t) const;

  int height() const noexcept { return image_.height(); }

 private:
  /// Draws a curve. @param top  of its area [pixels]  @param end  value at the top
  void fill(int top, Colour colour, const std::vector<double>& values, double end);
  int panel_height() const noexcept;  ///< of a curve's area [pixels]

  Image image_;  // all of it as it looks at the end
  double duration_;
  double feedrate_end_ = 1.0;  // of the upper scale [mm/s]
  double error_end_um_;
  bool has_error_;
};

/// Height of the strip under a picture [pixels].
int strip_height(int frame_height);

}  // namespace twin::pictures::video
