#pragma once

#include <Eigen/Geometry>

#include "core/vec.hpp"

namespace twin::pictures::video {

/// What a camera sees: axes of its picture in the world, and half its opening.
struct Lens {
  Vec3 right = Vec3::UnitX();          ///< unit vector to the right of the picture
  Vec3 up = Vec3::UnitY();             ///< unit vector to its top
  Vec2 tangent = Vec2::Constant(1.0);  ///< tangents of half the opening, across and up

  Vec3 forward() const { return up.cross(right); }  ///< unit vector into the picture
};

/// Box of the drawing in the world [m]: its middle, and half its sides across and along.
struct Framed {
  Vec3 middle = Vec3::Zero();
  Vec2 half = Vec2::Zero();
};

/// Where a camera of these axes stands so that a level box fills the picture but for a margin.
///
/// Nothing smaller than 60 mm fills it: the drawing's texels would be seen.
/// @returns the place of the camera [m]
Vec3 stand(const Lens& lens, const Framed& box);

/// Size in the picture of a length at the middle of the box. @param height  of the picture [pixels]
/// @returns [pixels/mm]
double pixels_per_mm(const Lens& lens, const Framed& box, const Vec3& camera, int height);

}  // namespace twin::pictures::video
