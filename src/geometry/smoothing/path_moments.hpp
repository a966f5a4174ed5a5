#pragma once

#include <array>
#include <cstddef>

#include "core/vec.hpp"
#include "geometry/smoothing/polygon.hpp"

namespace twin::geometry {

/// A part of a polygon: its blocks `first` to `last`.
struct Stretch {
  const Polygon* polygon = nullptr;
  std::size_t first = 0;  ///< index of the first block
  std::size_t last = 0;   ///< index of the last block, which belongs to the stretch
  double begin = 0.0;     ///< arc length of vertex `first` [mm]
  double end = 0.0;       ///< arc length of vertex `last` + 1 [mm]
};

/// Moments of the smooth path A(s) of a polygon over an interval of arc length. With x = -1..1 across the
/// interval and an origin O near it they are
///   m_k = integral of (A(s(x)) - O) x^k dx,   k = 0..3,   and the integral of |A - O|^2 dx.
///
/// Each integral is a sum over the blocks. On the part of a block with its middle at x = a and half
/// width d, A(s) is the parabola A = m + d' y + b (1/3 - y^2), y = -1..1, whose moments are
///   1/(2d) integral of A x^k dx = m                                                       | k = 0
///                                 a m + (d/3) d'                                          | k = 1
///                                 (a^2 + d^2/3) m + (2 a d/3) d' - (4/45) d^2 b           | k = 2
///                                 (a^3 + a d^2) m + (a^2 d + d^3/5) d' - (4/15) a d^2 b   | k = 3,
/// so they are exact, and each block costs the same time. Beyond an end of the stretch, A(s) goes on
/// as its own point reflection about that end, A(s_end + x) = 2 A_end - A(s_end - x).
///
/// @note Real-time safe.
class PathMoments {
 public:
  PathMoments() = default;
  /// @param stretch     the part of the polygon that is known
  /// @param block       index of a block near the begin of the interval, where the search starts
  /// @param begin, end  the interval of arc length [mm]
  PathMoments(const Stretch& stretch, std::size_t block, double begin, double end) noexcept;

  double begin() const noexcept { return begin_; }                         ///< [mm]
  double end() const noexcept { return end_; }                             ///< [mm]
  const Vec3& origin() const noexcept { return origin_; }                  ///< O [mm]
  const std::array<Vec3, 4>& moments() const noexcept { return moment_; }  ///< m_k [mm]
  double square() const noexcept { return square_; }  ///< integral of |A - O|^2 dx [mm^2]
  /// Number of blocks in the interval, whole or in part.
  int blocks() const noexcept { return blocks_; }
  /// Whether the interval begins inside a block, so that the one before it has a part of that, too.
  bool begins_inside() const noexcept { return begins_inside_; }

 private:
  void add(double from, const Vec3& start, double to, const Vec3& end, const Vec3& bulge) noexcept;
  void add_blocks(const Stretch& stretch, std::size_t block, double from, double to,
                  double mirror) noexcept;

  double begin_ = 0.0;
  double end_ = 0.0;
  double centre_ = 0.0;
  double inverse_ = 0.0;  // 1 / half width
  Vec3 origin_ = Vec3::Zero();
  std::array<Vec3, 4> moment_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double square_ = 0.0;
  int blocks_ = 0;
  bool begins_inside_ = false;
};

}  // namespace twin::geometry
