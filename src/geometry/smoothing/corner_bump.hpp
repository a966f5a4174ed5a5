#pragma once

#include <vector>

#include "core/vec.hpp"
#include "geometry/nurbs/span_cubic.hpp"

namespace twin::geometry {

/// A function that is added to a path around a corner and makes its first two derivatives
/// continuous there.
///
/// Let a path C(s) have the jumps D = C'(0+) - C'(0-) and K = C''(0+) - C''(0-) at a corner s = 0.
/// With y = |s| / h let
///   g(s) = (h/6) (1 - y)^3,                                                                    (1)
///   k(s) = sign(s) h^2 (y/12 - y^2/4 + 7/36 y^3)       y <= 1/2,
///          sign(s) (h^2/36) (1 - y)^3                  y > 1/2.                                (2)
/// At s = 0 the first derivative of g jumps by -1 and its second does not; the second derivative of
/// k jumps by -1 and its first does not. So the sum C + D g + K k is C2. At |s| = h and beyond, g,
/// k and their first two derivatives vanish. Both are cubic between -h, -h/2, 0, h/2 and h. They
/// move a point by no more than
///   |D| h / 6 + |K| h^2 / 120.                                                                 (3)
struct CornerBump {
  Vec3 turn = Vec3::Zero();  ///< D [-]
  Vec3 bend = Vec3::Zero();  ///< K [1/mm]

  /// Eq. (3) [mm].
  double height(double width) const noexcept;

  /// Largest width h with a height of at most `height` > 0; infinite where D and K are zero [mm].
  double width(double height) const noexcept;
};

/// Adds a bump of half width h about s = centre to the pieces of a path. Pieces are divided where
/// the cubics of the bump end. The pieces follow each other and cover centre - h to centre + h.
void add_bump(const CornerBump& bump, double centre, double width,
              std::vector<geometry::SpanCubic>& pieces);

}  // namespace twin::geometry
