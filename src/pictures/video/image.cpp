#include "pictures/video/image.hpp"

#include <algorithm>
#include <cmath>

namespace twin::pictures::video {

Rectangle united(const Rectangle& a, const Rectangle& b) noexcept {
  if (a.width <= 0 || a.height <= 0) {
    return b;
  }
  const int x = std::min(a.x, b.x);
  const int y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
          std::max(a.y + a.height, b.y + b.height) - y};
}

Image::Image(int width, int height, Colour fill)
    : width_(width),
      height_(height),
      pixels_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  if (fill == Colour{}) {
    return;
  }
  for (std::size_t i = 0; i < pixels_.size(); i += fill.size()) {
    std::copy(fill.begin(), fill.end(), pixels_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

Colour Image::at(int x, int y) const noexcept {
  const std::uint8_t* const pixel = data() + offset(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

namespace {

/// Mixes in 256ths: quick, and exact to half a step of 255.
void mix_pixel(std::uint8_t* pixel, const Colour& colour, int weight) noexcept {
  for (std::size_t i = 0; i < colour.size(); ++i) {
    pixel[i] = static_cast<std::uint8_t>(pixel[i] + ((weight * (colour[i] - pixel[i]) + 128) >> 8));
  }
}

int weight_of(double part) noexcept { return static_cast<int>(std::lround(256.0 * part)); }

}  // namespace

void Image::mix(int x, int y, Colour colour, double part) noexcept {
  if (x >= 0 && y >= 0 && x < width_ && y < height_) {
    mix_pixel(data() + offset(x, y), colour, weight_of(part));
  }
}

void Image::mix(const Rectangle& area, Colour colour, double part) noexcept {
  const int weight = weight_of(part);
  const int begin = std::max(area.x, 0);
  const int end = std::min(area.x + area.width, width_);
  for (int y = std::max(area.y, 0); y < std::min(area.y + area.height, height_); ++y) {
    for (int x = begin; x < end; ++x) {
      mix_pixel(data() + offset(x, y), colour, weight);
    }
  }
}

void Image::paste(const Image& picture, int x, int y) noexcept {
  const int left = std::max(x, 0);
  const int right = std::min(x + picture.width(), width_);
  for (int to = std::max(y, 0); to < std::min(y + picture.height(), height_) && left < right;
       ++to) {
    std::copy_n(picture.pixel(left - x, to - y), 3 * (right - left), pixel(left, to));
  }
}

}  // namespace twin::pictures::video
