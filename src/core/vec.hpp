#pragma once

#include <Eigen/Core>

namespace twin {

using Vec2 = Eigen::Vector2d;  ///< point or vector of the XY plane (2 x 1)
using Vec3 = Eigen::Vector3d;  ///< point or vector of the path (3 x 1)

}  // namespace twin
