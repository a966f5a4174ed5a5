#include "pictures/video/mip_texture.hpp"

#include <GL/gl.h>

#include <algorithm>

namespace twin::pictures::video {
namespace {

/// Fills a part of the next smaller level.
void shrink(const Image& from, Image& to, const Rectangle& part) {
  for (int y = part.y; y < part.y + part.height; ++y) {
    const std::uint8_t* const upper = from.row(std::min(2 * y, from.height() - 1));
    const std::uint8_t* const lower = from.row(std::min(2 * y + 1, from.height() - 1));
    for (int x = part.x; x < part.x + part.width; ++x) {
      const int left = 3 * std::min(2 * x, from.width() - 1);
      const int right = 3 * std::min(2 * x + 1, from.width() - 1);
      for (int i = 0; i < 3; ++i) {
        const int sum = upper[left + i] + upper[right + i] + lower[left + i] + lower[right + i];
        to.row(y)[3 * x + i] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
}

/// The pixels of the next smaller level that a part of this one goes into.
Rectangle halved(const Rectangle& part, const Image& to) {
  const int x = part.x / 2;
  const int y = part.y / 2;
  return {x, y, std::min((part.x + part.width + 1) / 2, to.width()) - x,
          std::min((part.y + part.height + 1) / 2, to.height()) - y};
}

void send(const Image& picture, int level, const Rectangle& part) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, picture.width());
  glTexSubImage2D(GL_TEXTURE_2D, level, part.x, part.y, part.width, part.height, GL_RGB,
                  GL_UNSIGNED_BYTE, picture.pixel(part.x, part.y));
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

}  // namespace

MipTexture::MipTexture(unsigned name) : name_(name) {
  glBindTexture(GL_TEXTURE_2D, name_);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width_);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height_);
  // Thin lines stay dark: levels three quarters of a step larger than OpenGL would take.
  glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, -0.75F);
  for (int level = 1; level < 32; ++level) {
    int width = 0;
    int height = 0;
    glGetTexLevelParameteriv(GL_TEXTURE_2D, level, GL_TEXTURE_WIDTH, &width);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, level, GL_TEXTURE_HEIGHT, &height);
    if (width < 1 || height < 1) {
      break;
    }
    smaller_.emplace_back(width, height);
  }
}

void MipTexture::update(const Image& picture, Rectangle changed) {
  if (changed.width <= 0 || changed.height <= 0) {
    return;
  }
  glBindTexture(GL_TEXTURE_2D, name_);
  send(picture, 0, changed);
  const Image* larger = &picture;
  for (std::size_t i = 0; i < smaller_.size(); ++i) {
    changed = halved(changed, smaller_[i]);
    if (changed.width <= 0 || changed.height <= 0) {
      return;
    }
    shrink(*larger, smaller_[i], changed);
    send(smaller_[i], static_cast<int>(i) + 1, changed);
    larger = &smaller_[i];
  }
}

}  // namespace twin::pictures::video
