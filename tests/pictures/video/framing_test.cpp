#include "pictures/video/framing.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace twin::pictures::video {
namespace framing_test {

/// A camera that looks down at an angle.
Lens tilted() {
  Lens lens;
  lens.right = Vec3(1.0, 1.0, 0.0).normalized();
  const Vec3 back = Vec3(0.5, -0.5, 0.8).normalized();
  lens.up = back.cross(lens.right).normalized();
  lens.tangent = {0.5, 0.3};
  return lens;
}

/// How far a corner of the box lies from the middle of the picture; 1 is its edge.
double place_in_picture(const Lens& lens, const Vec3& camera, const Vec3& point) {
  const Vec3 seen = point - camera;
  const double depth = lens.forward().dot(seen);
  EXPECT_GT(depth, 0.0);
  return std::max(std::abs(lens.right.dot(seen)) / (depth * lens.tangent.x()),
                  std::abs(lens.up.dot(seen)) / (depth * lens.tangent.y()));
}

TEST(Framing, TheFarthestCornerOfTheBoxLiesSevenTenthsOut) {
  const Lens lens = tilted();
  for (const Vec2& half : {Vec2(0.1, 0.1), Vec2(0.2, 0.05), Vec2(0.04, 0.3)}) {
    const Framed box{{0.02, -0.01, 0.5}, half};
    const Vec3 camera = stand(lens, box);
    double farthest = 0.0;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Vec3 corner = box.middle + Vec3(x * half.x(), y * half.y(), 0.0);
        farthest = std::max(farthest, place_in_picture(lens, camera, corner));
      }
    }
    EXPECT_NEAR(farthest, 0.7, 1e-9);
  }
}

TEST(Framing, NothingSmallerThanSixtyMillimetresFillsThePicture) {
  const Vec3 middle(0.0, 0.0, 0.5);
  EXPECT_EQ(stand(tilted(), {middle, {0.001, 0.002}}), stand(tilted(), {middle, {0.03, 0.03}}));
}

TEST(Framing, AMillimetreInTheMiddleHasTheSizeOfAPinholeCamera) {
  Lens lens;  // straight down
  lens.tangent = {0.5, 0.25};
  const Framed box{{0.0, 0.0, 0.0}, {0.1, 0.1}};
  EXPECT_NEAR(pixels_per_mm(lens, box, {0.0, 0.0, 2.0}, 1000), 1.0, 1e-12);
}

}  // namespace framing_test
}  // namespace twin::pictures::video
