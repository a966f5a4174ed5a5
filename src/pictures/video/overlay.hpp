#pragma once

#include <string>

#include "pictures/video/colour_scale.hpp"
#include "pictures/video/font.hpp"
#include "pictures/video/strip.hpp"
#include "pictures/video/trace_rows.hpp"

namespace twin::pictures::video {

/// What the overlay says about one frame.
struct Readout {
  TraceRow row;        ///< the newest row of the trace
  Image inset;         ///< magnified drawing; empty: the scale alone
  Vec2 pen{0.0, 0.0};  ///< place of the pen in the inset [pixels]
};

/// Text, magnified drawing and colour scale on top of a frame, and the strip under the scene.
class Overlay {
 public:
  /// @param title     first line of the read-out
  /// @param duration  machining time [s]
  /// @param has_error show contour error and colour scale
  Overlay(Font font, ColourScale scale, Strip strip, std::string title, double duration,
          bool has_error);

  void draw(Image& frame, const Readout& readout) const;

 private:
  void draw_readout(Image& frame, const TraceRow& row) const;
  void draw_inset(Image& frame, const Readout& readout) const;
  void draw_scale(Image& frame, const Rectangle& area) const;

  Font font_;
  ColourScale scale_;
  Strip strip_;
  std::string title_;
  double duration_;  // [s]
  bool has_error_;
};

/// Size of the inset for a frame: a square or narrower, as the drawing is.
///
/// @param extent  width and height of the drawing [mm]
Rectangle inset_size(int frame_width, int frame_height, const Vec2& extent);

}  // namespace twin::pictures::video
