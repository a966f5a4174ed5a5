#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/vec.hpp"
#include "studies/circular/circle_program.hpp"

namespace twin::test {

inline constexpr double kTurn = 2.0 * std::numbers::pi;

/// One turn about a centre in either sense, with the radius a function of the angle.
///
/// @param radius  of an angle from -1 to 7.3 rad [mm]
inline std::vector<Vec2> path_of(
    const std::function<double(double)>& radius,
    studies::circular::Sense sense = studies::circular::Sense::kCounterClockwise,
    const Vec2& centre = Vec2::Zero(), int count = 3600) {
  std::vector<Vec2> path;
  for (int i = 0; i < count; ++i) {
    const double angle =
        0.6435 + studies::circular::sign_of(sense) * kTurn * i / count;  // starts at (0.8, 0.6)
    path.push_back(centre + radius(angle) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return path;
}

}  // namespace twin::test
