#include "pictures/video/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twin::pictures::video {

Canvas::Canvas(int width, int height, Colour background, double line_width)
    : image_(width, height, background),
      covered_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      background_(background),
      half_width_(line_width / 2.0),
      changed_{0, 0, width, height} {}

void Canvas::line(const Vec2& a, const Vec2& b, Colour colour) {
  const double reach = half_width_ + 0.5;
  const auto first = [reach](double low, int) { return std::max(0.0, std::floor(low - reach)); };
  const auto last = [reach](double high, int size) {
    return std::min(static_cast<double>(size), std::ceil(high + reach));
  };
  const int x_begin = static_cast<int>(first(std::min(a.x(), b.x()), 0));
  const int y_begin = static_cast<int>(first(std::min(a.y(), b.y()), 0));
  const int x_end = static_cast<int>(last(std::max(a.x(), b.x()), image_.width()));
  const int y_end = static_cast<int>(last(std::max(a.y(), b.y()), image_.height()));
  if (x_begin >= x_end || y_begin >= y_end) {
    return;
  }
  changed_ = united(changed_, {x_begin, y_begin, x_end - x_begin, y_end - y_begin});
  const Vec2 along = b - a;
  const double length2 = along.squaredNorm();
  for (int y = y_begin; y < y_end; ++y) {
    for (int x = x_begin; x < x_end; ++x) {
      const Vec2 from_a = Vec2(x + 0.5, y + 0.5) - a;
      const double f = length2 > 0.0 ? std::clamp(from_a.dot(along) / length2, 0.0, 1.0) : 0.0;
      const double part = std::clamp(reach - (from_a - f * along).norm(), 0.0, 1.0);
      const auto covered = static_cast<std::uint8_t>(std::lround(255.0 * part));
      std::uint8_t& before =
          covered_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width()) +
                   static_cast<std::size_t>(x)];
      if (covered > 0 && covered >= before) {
        before = covered;
        image_.mix(x, y, background_, 1.0);
        image_.mix(x, y, colour, part);
      }
    }
  }
}

Rectangle Canvas::take_changed() noexcept { return std::exchange(changed_, Rectangle{}); }

void PenTrail::advance(const TraceRow& row) {
  constexpr double shortest = 0.5;  // [pixels]
  if (row.position.z() > pen_up_) {
    last_.reset();
    return;
  }
  const Vec2 here = map_(row.position.head<2>());
  largest_rms_um_ = std::max(largest_rms_um_, row.error_rms_um);
  if (last_ && (here - *last_).norm() < shortest) {
    return;
  }
  canvas_.line(last_.value_or(here), here, scale_.colour(largest_rms_um_));
  last_ = here;
  largest_rms_um_ = 0.0;
}

}  // namespace twin::pictures::video
