#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.hpp"
#include "pictures/video/image.hpp"

namespace twin::pictures::video {

/// A picture on which a line of many short pieces is drawn, smooth at its edges.
///
/// A piece from a to b covers of a pixel at distance d from it the part clamp(w / 2 + 1/2 - d, 0,
/// 1), w the width. Each pixel remembers the largest part so far and is mixed from the background
/// anew: pieces that overlap, as all do that follow each other, leave the edges as smooth as one
/// piece would. A later piece lies on top of an earlier one.
class Canvas {
 public:
  /// @param line_width  w, at least 1 [pixels]
  Canvas(int width, int height, Colour background, double line_width);

  /// Draws one piece; what reaches over the edge is left out.
  /// @param a,b  ends [pixels], (0, 0) the left upper corner, pixel centres at halves
  void line(const Vec2& a, const Vec2& b, Colour colour);

  const Image& image() const noexcept { return image_; }
  /// The part that was drawn on since the last call; all of it the first time, empty when nothing
  /// was.
  Rectangle take_changed() noexcept;

 private:
  Image image_;
  std::vector<std::uint8_t> covered_;  // largest part of each pixel, 255 all of it
  Colour background_;
  double half_width_;
  Rectangle changed_;
};

}  // namespace twin::pictures::video
