#pragma once

#include <optional>

#include "core/vec.hpp"
#include "gcode/block.hpp"
#include "gcode/interpreter/plane.hpp"

namespace twin::gcode {

/// One straight line or arc of a contour in its plane, and the curve beside it on which the centre
/// of a cutter goes.
///
/// With the unit tangent t of the contour and the normal n to its left, the curve is C + d n, d > 0
/// to the left. Beside an arc of radius R it is an arc about the same centre of radius R - d where
/// the arc turns left, and R + d where it turns right.
class OffsetSide {
 public:
  OffsetSide() = default;

  /// @param block     a line or an arc of some length in the plane
  /// @param distance  d [mm]
  OffsetSide(const Block& block, const PlaneAxes& axes, double distance);

  bool is_arc() const noexcept { return turn_ != 0.0; }
  double turn() const noexcept { return turn_; }  ///< 1 to the left, -1 to the right, 0 straight on
  const Vec2& centre() const noexcept { return centre_; }  ///< of an arc [mm]
  double sweep() const noexcept { return sweep_; }         ///< of an arc [rad]

  const Vec2& first_tangent() const noexcept { return first_tangent_; }
  const Vec2& last_tangent() const noexcept { return last_tangent_; }
  Vec2 first() const noexcept;  ///< start of the curve beside it [mm]
  Vec2 last() const noexcept;   ///< its end [mm]

  /// Whether the curve beside an arc still turns the way the arc does.
  bool is_sound() const noexcept;

  /// Puts the centre of an arc elsewhere; start and end must then lie on a circle about it.
  void move_centre(const Vec2& centre, double sweep) noexcept;

 private:
  friend std::optional<Vec2> meeting_point(const OffsetSide& before, const OffsetSide& after);
  double first_radius() const noexcept { return (contour_first_ - centre_).norm() - turn_ * d_; }
  double last_radius() const noexcept { return (contour_last_ - centre_).norm() - turn_ * d_; }

  double d_ = 0.0;
  Vec2 contour_first_ = Vec2::Zero();
  Vec2 contour_last_ = Vec2::Zero();
  Vec2 first_tangent_ = Vec2::UnitX();
  Vec2 last_tangent_ = Vec2::UnitX();
  double turn_ = 0.0;
  Vec2 centre_ = Vec2::Zero();
  double sweep_ = 0.0;
};

/// The place where the curve beside one piece of a contour meets that beside the next, in a corner
/// which the cutter is inside of: of two such places that nearest the corner.
/// @returns nullopt if they do not meet
std::optional<Vec2> meeting_point(const OffsetSide& before, const OffsetSide& after);

}  // namespace twin::gcode
