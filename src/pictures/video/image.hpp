#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace twin::pictures::video {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A rectangle of pixels; x to the right, y down, (0, 0) the left upper pixel.
struct Rectangle {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The smallest rectangle that covers both; an empty one does not count.
Rectangle united(const Rectangle& a, const Rectangle& b) noexcept;

/// A picture of 8-bit RGB pixels, row 0 at the top.
class Image {
 public:
  Image() = default;
  Image(int width, int height, Colour fill = {0, 0, 0});

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  std::uint8_t* data() noexcept { return pixels_.data(); }  ///< (height x width x 3)
  const std::uint8_t* data() const noexcept { return pixels_.data(); }
  std::uint8_t* row(int y) noexcept { return pixel(0, y); }
  const std::uint8_t* row(int y) const noexcept { return pixel(0, y); }
  std::uint8_t* pixel(int x, int y) noexcept { return data() + offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const noexcept { return data() + offset(x, y); }
  Colour at(int x, int y) const noexcept;

  /// Mixes a colour into one pixel; nothing happens outside of the picture. @param part 0 to 1
  void mix(int x, int y, Colour colour, double part) noexcept;
  /// Mixes a colour into a rectangle, which may reach over the edge.
  void mix(const Rectangle& area, Colour colour, double part) noexcept;
  /// Copies a whole picture to (x, y); what reaches over the edge is left out.
  void paste(const Image& picture, int x, int y) noexcept;

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::size_t offset(int x, int y) const noexcept {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(x));
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace twin::pictures::video
