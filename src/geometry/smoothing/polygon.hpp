#pragma once

#include "core/vec.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

namespace twin::geometry {

/// The programmed points of a run of short blocks, with the arc length of the polygon through them,
/// and the smooth path that they suggest.
///
/// Block i goes straight from vertex i to vertex i + 1,
///   V(s) = V_i + (s - s_i) e_i,   s_i <= s <= s_{i+1},   s_{i+1} = s_i + L_i.
/// Programs cut rounds into chords. The round is estimated from the curvature at the vertices and
/// the sagitta of the blocks,
///   k_i = 2 (e_i - e_{i-1}) / (L_{i-1} + L_i),   b_i = -(L_i^2 / 8) minmod(k_i, k_{i+1}),
/// where minmod is the shorter of two vectors that point to one side, and zero for any others:
///   A(s) = A_i + f (A_{i+1} - A_i) + 4 f (1 - f) b_i,   f = (s - s_i) / L_i,
///   A_i = V_i + (L_{i-1} L_i / 16) k_i.
/// A(s) lies half a sagitta inside the vertices and half a sagitta outside the chords. At the ends
/// of a run k = 0. The numbers of block i do not change any more once block i + 1 is there, or once
/// it is known that none follows.
class Polygon {
 public:
  struct Vertex {
    Vec3 at;         ///< V_i [mm]
    Vec3 direction;  ///< e_i, of the block that begins here; unit vector, zero at the last vertex
    Vec3 aim;        ///< A_i [mm]
    Vec3 bend;       ///< k_i [1/mm]
    Vec3 bulge;      ///< b_i, of the block that begins here [mm]
    double s;        ///< arc length s_i [mm]
    double turn;     ///< angle between the blocks that meet here, nearly; 0 at both ends [rad]
  };

  /// Begins at a point with a given arc length.
  void start(const Vec3& at, double s);
  /// Appends a block; it must not end where it begins.
  void push(const Vec3& end);
  /// The turn at vertex i is none of the run's: it is an end of it.
  void forget_turn(std::size_t i) noexcept;
  /// Forgets the vertices before index i.
  void drop_before(std::size_t i) { vertices_.drop_before(i); }

  const Vertex& operator[](std::size_t i) const noexcept { return vertices_[i]; }
  std::size_t first() const noexcept { return vertices_.begin_index(); }
  std::size_t last() const noexcept { return vertices_.end_index() - 1; }

  /// A(s) on block i [mm].
  Vec3 aim(std::size_t i, double s) const noexcept;

  /// Block that holds s, looked for from block i on, either way, among blocks `lowest` to
  /// `highest`.
  std::size_t block_at(double s, std::size_t i, std::size_t lowest,
                       std::size_t highest) const noexcept;

 private:
  SlidingVector<Vertex> vertices_;
};

}  // namespace twin::geometry
