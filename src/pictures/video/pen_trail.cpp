#include "pictures/video/pen_trail.hpp"

#include <algorithm>

namespace twin::pictures::video {

void PenTrail::advance(const TraceRow& row) {
  constexpr double shortest = 0.5;  // [pixels]
  if (row.position.z() > pen_up_) {
    last_.reset();
    return;
  }
  const Vec2 here = map_(row.position.head<2>());
  largest_error_um_ = std::max(largest_error_um_, row.error_um);
  if (last_ && (here - *last_).norm() < shortest) {
    return;
  }
  canvas_.line(last_.value_or(here), here, scale_.colour(largest_error_um_));
  last_ = here;
  largest_error_um_ = 0.0;
}

}  // namespace twin::pictures::video
