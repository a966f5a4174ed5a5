#include "path/corner/corner_motion.hpp"

#include <algorithm>
#include <cmath>

namespace twin::path {
namespace {

/// Share of V up to which the feedrate may change within a passage. A larger one leaves less
/// acceleration and jerk for that: at 1 nothing is left.
constexpr double kSlow = 0.6;

/// Share of the jerk that the product of feedrate and acceleration may use.
constexpr double kMixedShare = 0.4;

}  // namespace

SlowPassage slow_passage(const CornerMotion& passage) noexcept {
  const double acceleration = passage.acceleration;
  const double jerk = passage.jerk;
  const double most = passage.half->acceleration;
  const double v = kSlow * passage.feedrate;
  const double mixed = 3.0 * most * kSlow / passage.feedrate;  // jerk for each mm/s^2
  return {v,
          std::min(acceleration - kSlow * kSlow * std::min(most, acceleration),
                   kMixedShare * jerk / mixed),
          (1.0 - kMixedShare - kSlow * kSlow * kSlow) * jerk};
}

SpaceMotion motion_in(const CornerMotion& passage, double s, double v, double a) noexcept {
  const HalfCorner& half = *passage.half;
  const double t = std::clamp(s / passage.feedrate / passage.scale - half.duration, -half.duration,
                              half.duration);
  const double piece = half.duration / HalfCorner::kPieces;
  const double from_middle = std::abs(t);
  const auto i = std::min(static_cast<std::size_t>(from_middle / piece), HalfCorner::kPieces - 1);
  const HalfCorner::Node& node = half.nodes[i];
  const double h = from_middle - piece * static_cast<double>(i);
  Vec2 position =
      node.position + h * (node.velocity + h * (node.acceleration / 2.0 + h * node.jerk / 6.0));
  Vec2 velocity = node.velocity + h * (node.acceleration + h * node.jerk / 2.0);
  Vec2 acceleration = node.acceleration + h * node.jerk;
  if (t < 0.0) {  // x is odd in time, y is even
    position.x() = -position.x();
    velocity.y() = -velocity.y();
    acceleration.x() = -acceleration.x();
  }
  const auto in_space = [&](const Vec2& at) -> Vec3 {
    return at.x() * passage.x + at.y() * passage.y;
  };
  const double rate = 1.0 / (passage.scale * passage.feedrate);  // of t by s
  const Vec3 first = rate * in_space(velocity);
  const Vec3 second = (rate * rate) * in_space(acceleration);
  return {passage.corner + in_space(position), v * first, a * first + (v * v) * second};
}

}  // namespace twin::path
