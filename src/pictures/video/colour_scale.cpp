#include "pictures/video/colour_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace twin::pictures::video {

double round_up(double value) {
  if (!(value > 0.0)) {
    return 1.0;
  }
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (digit * decade >= value * (1.0 - 1e-12)) {
      return digit * decade;
    }
  }
  return 10.0 * decade;
}

ColourScale::ColourScale(double largest_error_um) : end_um_(round_up(largest_error_um)) {}

Colour ColourScale::colour(double error_um) const noexcept {
  constexpr std::array<Colour, 6> plasma{
      {{13, 8, 135}, {84, 2, 163}, {139, 10, 165}, {185, 50, 137}, {219, 92, 104}, {244, 136, 73}}};
  constexpr std::size_t last = plasma.size() - 1;
  const double place = std::clamp(error_um / end_um_, 0.0, 1.0) * last;
  const std::size_t below = std::min(static_cast<std::size_t>(place), last - 1);
  const double part = place - static_cast<double>(below);
  Colour result{};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double from = plasma[below][i];
    const double to = plasma[below + 1][i];
    result[i] = static_cast<std::uint8_t>(std::lround(from + part * (to - from)));
  }
  return result;
}

}  // namespace twin::pictures::video
