#pragma once

#include <functional>
#include <optional>

#include "core/vec.hpp"
#include "pictures/video/canvas.hpp"
#include "pictures/video/colour_scale.hpp"
#include "pictures/video/trace_rows.hpp"

namespace twin::pictures::video {

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
  double pen_up_;                  // [mm]
  std::optional<Vec2> last_;       // end of the last piece [pixels]; none while the pen is up
  double largest_error_um_ = 0.0;  // since then
};

}  // namespace twin::pictures::video
