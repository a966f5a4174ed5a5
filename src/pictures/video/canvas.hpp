#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/vec.hpp"
#include "pictures/video/colour_scale.hpp"
#include "pictures/video/image.hpp"
#include "pictures/video/trace_rows.hpp"

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

  void set_line_width(double line_width) noexcept { half_width_ = line_width / 2.0; }

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

/// Draws the pen's trace onto a canvas, row by row, coloured by contour error.
///
/// Pieces shorter than half a pixel are joined to the next one, which takes the largest of their
/// errors.
class PenTrail {
 public:
  using Map = std::function<Vec2(const Vec2&)>;  ///< from the plate [mm] to the canvas [pixels]

  PenTrail(Canvas canvas, Map map, ColourScale scale, double pen_up)
      : canvas_(std::move(canvas)), map_(std::move(map)), scale_(scale), pen_up_(pen_up) {}

  void advance(const TraceRow& row);

  Canvas& canvas() noexcept { return canvas_; }
  Vec2 place(const Vec2& position) const { return map_(position); }

 private:
  Canvas canvas_;
  Map map_;
  ColourScale scale_;
  double pen_up_;                // [mm]
  std::optional<Vec2> last_;     // end of the last piece [pixels]; none while the pen is up
  double largest_rms_um_ = 0.0;  // since then
};

}  // namespace twin::pictures::video
