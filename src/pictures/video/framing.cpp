#include "pictures/video/framing.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace twin::pictures::video {
namespace {

constexpr double kFilled =
    0.70;  // part of the picture that the box takes at most; text stands beside
constexpr double kLeastHalf = 0.03;  // [m]

}  // namespace

Vec3 stand(const Lens& lens, const Framed& box) {
  const Vec3 forward = lens.forward();
  const Vec2 half = box.half.cwiseMax(kLeastHalf);
  double distance = 0.0;
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      const Vec3 corner(x, y, 0.0);
      const double nearer = forward.dot(corner);
      distance = std::max({distance,
                           std::abs(lens.right.dot(corner)) / (kFilled * lens.tangent.x()) - nearer,
                           std::abs(lens.up.dot(corner)) / (kFilled * lens.tangent.y()) - nearer});
    }
  }
  return box.middle - distance * forward;
}

double pixels_per_mm(const Lens& lens, const Framed& box, const Vec3& camera, int height) {
  const double depth = (box.middle - camera).norm();
  return units::m_from_mm(1.0) * 0.5 * height / (lens.tangent.y() * depth);
}

}  // namespace twin::pictures::video
