#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/vec.hpp"

namespace twin::motion {

/// Offsets of the set points of one run, one for each interpolation period.
///
/// A correction belongs to one sequence of set points and is of no use to any other, so it keeps
/// the set points that it was made for.
struct Correction {
  std::vector<Vec3> points;   ///< set points without the offsets (periods) [mm]
  std::vector<Vec2> offsets;  ///< of x and y, as many [mm]
};

/// What is added to a set point.
struct Offset {
  Vec3 position = Vec3::Zero();      ///< [mm]
  Vec3 velocity = Vec3::Zero();      ///< [mm/s]
  Vec3 acceleration = Vec3::Zero();  ///< [mm/s^2]
};

/// Share of the first offset that is in force after a time at rest before the path.
///
/// It rises from 0 to 1 within 0.2 s as the polynomial of degree 5 whose first and second
/// derivatives are 0 at both ends. @param time  since the rest began [s]
double share_at_rest(double time) noexcept;

/// Goes through a correction, one period after the other, beside the interpolator.
///
/// Before the path the first offset is approached at rest, so that the path begins with it. On the
/// path period k gets offset o_k, and with it the velocity (o_(k+1) - o_(k-1)) / 2T and the
/// acceleration (o_(k+1) - 2 o_k + o_(k-1)) / T^2. Behind the last set point the last offset stays.
///
/// Feed override, hold, a stop and a plan that differs for any other reason lead to set points that
/// the correction was not made for. The first set point that differs by more than 1 nm is the end of
/// the correction: from there on the offset is w(t) o_k, and w falls from 1 to 0 within 0.2 s by the
/// same polynomial. It does not come back in this run. Every function is real-time safe.
class CorrectionFollower {
 public:
  static constexpr double kFadeTime = 0.2;    ///< of w, and of the approach at rest [s]
  static constexpr double kTolerance = 1e-6;  ///< of a set point [mm]

  /// @param correction  outlives the follower; null: there is none, and every offset is 0
  /// @param period      interpolation period T [s]
  CorrectionFollower(const Correction* correction, double period) noexcept
      : correction_(correction), period_(period) {}

  bool has_correction() const noexcept { return correction_ != nullptr; }
  /// A period at rest before the first set point.
  void rest() noexcept;
  /// A period with the next set point [mm].
  void follow(const Vec3& point) noexcept;
  /// A period without a set point after the first one: the motion rests on the path, or has ended.
  void wait() noexcept;

  /// What is added to the set point of this period.
  const Offset& offset() const noexcept { return offset_; }
  /// Number of the set point from which the correction fades, or a negative number.
  std::ptrdiff_t left_at() const noexcept { return left_at_; }

 private:
  Vec2 at(std::ptrdiff_t period) const noexcept;
  void update() noexcept;
  std::ptrdiff_t size() const noexcept {
    return static_cast<std::ptrdiff_t>(correction_->offsets.size());
  }

  const Correction* correction_;
  double period_;                // T [s]
  std::ptrdiff_t now_ = -1;      // number of the present period, 0 at the first set point
  std::ptrdiff_t left_at_ = -1;  // period in which the fading began
  long rested_ = 0;              // periods at rest before the path
  Offset offset_;
};

}  // namespace twin::motion
