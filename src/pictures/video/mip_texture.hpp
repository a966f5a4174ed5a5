#pragma once

#include <vector>

#include "pictures/video/image.hpp"

namespace twin::pictures::video {

/// A texture of OpenGL with its smaller copies (mipmaps), of which only the part that changed is
/// sent.
///
/// A pixel of level k + 1 is the mean of two by two pixels of level k. Sending all of a plate's
/// drawing in every frame would cost more than the encoder.
class MipTexture {
 public:
  /// @param name  of a two-dimensional texture in OpenGL, RGB; its size and number of levels stay
  /// as they are
  explicit MipTexture(unsigned name);

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }

  /// Sends the part of a picture that changed. @param picture  of the texture's size
  void update(const Image& picture, Rectangle changed);

 private:
  unsigned name_;
  int width_ = 0;
  int height_ = 0;
  std::vector<Image> smaller_;  // levels 1, 2, ...
};

}  // namespace twin::pictures::video
