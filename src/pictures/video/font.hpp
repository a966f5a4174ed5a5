#pragma once

#include <array>
#include <string_view>

#include "pictures/video/image.hpp"

namespace twin::pictures::video {

class TableScene;

/// Letters with smooth edges, for text on a finished picture.
///
/// MuJoCo's own letters have hard edges. They are drawn once at twice the size, and each pixel here
/// is the mean of four of theirs. Characters outside of ASCII 32 to 126 are shown as '?'.
class Font {
 public:
  static Font make(TableScene& scene);

  int height() const noexcept { return height_; }   ///< of a line [pixels]
  int width(std::string_view text) const noexcept;  ///< [pixels]
  /// Writes a line. @param x,y  left upper corner
  void write(Image& picture, int x, int y, std::string_view text, Colour colour) const;

 private:
  struct Letter {
    int width = 0;   // [pixels]
    Image coverage;  // red channel: covered part, 255 all of it
  };
  const Letter& letter(char character) const noexcept;

  int height_ = 0;
  std::array<Letter, 95> letters_;
};

}  // namespace twin::pictures::video
