#pragma once

#include "core/error.hpp"
#include "core/vec.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "geometry/arc.hpp"

namespace twin::gcode {

/// How far start and end radius of an arc may differ if nothing else is said [mm], or a thousandth of
/// the radius if that is more, up to a hundred times this.
inline constexpr double kRadiusSlack = 0.02;

/// What a line with G02 or G03 says apart from its centre or radius.
struct ArcEnds {
  Vec3 start = Vec3::Zero();  ///< [mm]
  Vec3 end = Vec3::Zero();    ///< [mm]
  Plane plane = Plane::kXy;
  bool is_clockwise = false;  ///< seen from the tip of the plane's third axis
};

/// An arc and the end it really has.
struct ProgrammedArc {
  geometry::Arc geometry;
  Vec3 end = Vec3::Zero();  ///< the programmed end; of a full circle, with its angle put onto the
                            ///< start's [mm]
};

/// Arc about a centre given from the start (I J K).
///
/// In the plane let u go from the centre to the start, d from start to end, v = u + d, and let the
/// sense s be 1 counter-clockwise and -1 clockwise. Then
///   sweep = atan2(s (u x v), u . v) = atan2(s (u x d), u . v)   wrapped into (0, 2 pi], (1)
/// where the second form, u x u being zero, keeps its digits for a short arc of a large circle. A
/// turn of less than kNoLength along the arc is a full circle.
///
/// @param ends    start, end, plane and sense
/// @param offset  from the start to the centre; its part along the third axis is not used [mm]
/// @param slack   how far start and end radius may differ, if that is more than a thousandth; a
///                hundred times as much is the most [mm]
/// @returns the arc, or an error with column 0 if the radius is zero or the ends do not lie on one
///          circle
Expected<ProgrammedArc> arc_by_offset(const ArcEnds& ends, const Vec3& offset,
                                      double slack = kRadiusSlack);

/// Arc of a given radius (R), less than half a turn for R > 0, more for R < 0.
///
/// With the chord d of length c the centre is
///   start + d / 2 + h (n x d) / c,  h = +-sqrt((|R| - c / 2) (|R| + c / 2)), (2)
/// n the plane's third axis, + where sense and sign of R agree (counter-clockwise and R > 0, or
/// neither). A chord longer than 2 |R| by no more than 2 kRadiusSlack makes a half circle.
///
/// @param ends    start, end, plane and sense
/// @param radius  radius with sign [mm]
/// @returns the arc, or an error with column 0 if the radius is zero or cannot span the chord, or
///          if start and end are the same point
Expected<ProgrammedArc> arc_by_radius(const ArcEnds& ends, double radius);

}  // namespace twin::gcode
