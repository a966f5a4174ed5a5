#pragma once

#include "core/vec.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

namespace twin::geometry {

/// The programmed points of a run of short blocks: the polygon through them, its arc length s, and
/// an estimate A(s) of the smooth path that the blocks approximate.
///
/// Block i goes straight from vertex i to vertex i + 1,
///   V(s) = V_i + (s - s_i) e_i,   s_i <= s <= s_{i+1},   s_{i+1} = s_i + L_i.
/// A CAM system has made these blocks as chords of a curve. The curve is estimated from the
/// curvature k_i at the vertices and the sagitta b_i of the blocks,
///   k_i = 2 (e_i - e_{i-1}) / (L_{i-1} + L_i),   b_i = -(L_i^2 / 8) minmod(k_i, k_{i+1}),
/// where minmod is the shorter of two vectors that point to the same side, and zero for any others:
///   A(s) = A_i + f (A_{i+1} - A_i) + 4 f (1 - f) b_i,   f = (s - s_i) / L_i,
///   A_i = V_i + (L_{i-1} L_i / 16) k_i.
/// A(s) lies half a sagitta inside the vertices and half a sagitta outside the chords. At the ends
/// of a run k = 0. The values of block i are final once block i + 1 has been appended, or once it
/// is known that no block follows.
class Polygon {
 public:
  struct Vertex {
    Vec3 at;         ///< V_i [mm]
    Vec3 direction;  ///< e_i, unit vector along the block that begins here; 0 at the last vertex
    Vec3 aim;        ///< A_i [mm]
    Vec3 bend;       ///< curvature vector k_i [1/mm]
    Vec3 bulge;      ///< sagitta b_i of the block that begins here [mm]
    double s;        ///< arc length s_i [mm]
    double turn;     ///< approximate angle between the blocks that meet here; 0 at the ends [rad]
  };

  /// Begins a polygon at a point. @param s  arc length there [mm]
  void start(const Vec3& at, double s);
  /// Appends the block from the last vertex to this point, which must be another one [mm].
  void push(const Vec3& end);
  /// Sets the turn at vertex i to 0, because the run has been cut there.
  void forget_turn(std::size_t i) noexcept;
  /// Removes the vertices before index i, which are not needed any more.
  void drop_before(std::size_t i) { vertices_.drop_before(i); }

  const Vertex& operator[](std::size_t i) const noexcept { return vertices_[i]; }
  std::size_t first() const noexcept { return vertices_.begin_index(); }
  std::size_t last() const noexcept { return vertices_.end_index() - 1; }

  /// A(s) on block i [mm].
  Vec3 aim(std::size_t i, double s) const noexcept;

  /// Index of the block that contains the arc length s. The search starts at block i, goes in
  /// either direction, and stays within the blocks `lowest` to `highest`.
  std::size_t block_at(double s, std::size_t i, std::size_t lowest,
                       std::size_t highest) const noexcept;

 private:
  SlidingVector<Vertex> vertices_;
};

}  // namespace twin::geometry
