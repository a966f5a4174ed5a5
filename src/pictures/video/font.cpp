#include "pictures/video/font.hpp"

#include <algorithm>
#include <string>

#include "pictures/video/table_scene.hpp"

namespace twin::pictures::video {
namespace {

constexpr char kFirst = ' ';

/// Mean of two by two pixels, red channel.
std::uint8_t mean_of_four(const Image& image, int x, int y) {
  int sum = 0;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      sum += image.at(2 * x + dx, 2 * y + dy)[0];
    }
  }
  return static_cast<std::uint8_t>(sum / 4);
}

}  // namespace

Font Font::make(TableScene& scene) {
  Font font;
  font.height_ = scene.character_height() / 2;
  for (std::size_t i = 0; i < font.letters_.size(); ++i) {
    const Image large = scene.render_character(static_cast<char>(kFirst + static_cast<char>(i)));
    Letter& letter = font.letters_[i];
    letter.width = large.width() / 2;
    letter.coverage = Image(letter.width, font.height_);
    for (int y = 0; y < font.height_; ++y) {
      for (int x = 0; x < letter.width; ++x) {
        *letter.coverage.pixel(x, y) = mean_of_four(large, x, y);
      }
    }
  }
  return font;
}

const Font::Letter& Font::letter(char character) const noexcept {
  const bool is_known = character >= ' ' && character <= '~';
  return letters_[static_cast<std::size_t>((is_known ? character : '?') - kFirst)];
}

int Font::width(std::string_view text) const noexcept {
  int sum = 0;
  for (const char character : text) {
    sum += letter(character).width;
  }
  return sum;
}

void Font::write(Image& picture, int x, int y, std::string_view text, Colour colour) const {
  for (const char character : text) {
    const Letter& shape = letter(character);
    for (int dy = 0; dy < height_; ++dy) {
      for (int dx = 0; dx < shape.width; ++dx) {
        const std::uint8_t part = *shape.coverage.pixel(dx, dy);
        if (part > 0) {
          picture.mix(x + dx, y + dy, colour, part / 255.0);
        }
      }
    }
    x += shape.width;
  }
}

}  // namespace twin::pictures::video
