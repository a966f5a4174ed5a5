#pragma once

#include "core/vec.hpp"
#include "smoothing/sliding_vector.hpp"

namespace twin::smoothing {

/// The programmed points of a run of short blocks, with the arc length of the polygon through them.
///
/// Block i goes from vertex i to vertex i + 1,
///   V(s) = V_i + (s - s_i) e_i,   s_i <= s <= s_{i+1},   s_{i+1} = s_i + |V_{i+1} - V_i|.
class Polygon {
 public:
  struct Vertex {
    Vec3 at;         ///< V_i [mm]
    Vec3 direction;  ///< e_i, of the block that begins here; unit vector, zero at the last vertex
    double s;        ///< arc length s_i [mm]
    double turn;     ///< angle between the blocks that meet here, nearly; 0 at both ends [rad]
  };

  /// Begins at a point with a given arc length.
  void start(const Vec3& at, double s);
  /// Appends a block; it must not end where it begins.
  void push(const Vec3& end);
  /// The turn at vertex i is none of the run's: it is an end of it.
  void forget_turn(std::size_t i) noexcept { vertices_[i].turn = 0.0; }
  /// Forgets the vertices before index i.
  void drop_before(std::size_t i) { vertices_.drop_before(i); }

  const Vertex& operator[](std::size_t i) const noexcept { return vertices_[i]; }
  std::size_t first() const noexcept { return vertices_.begin_index(); }
  std::size_t last() const noexcept { return vertices_.end_index() - 1; }

  /// V(s) on block i [mm].
  Vec3 point(std::size_t i, double s) const noexcept {
    return vertices_[i].at + (s - vertices_[i].s) * vertices_[i].direction;
  }

  /// Square of the height of the arc over block i that the turns at both of its ends suggest
  /// [mm^2].
  ///
  /// A circle's chord of length L turns by theta = L / R at each end, and its arc is L theta / 8
  /// high.
  double bulge_squared(std::size_t i) const noexcept {
    const double length = vertices_[i + 1].s - vertices_[i].s;
    const double bulge = length * (vertices_[i].turn + vertices_[i + 1].turn) / 16.0;
    return bulge * bulge;
  }

  /// Block that holds s, looked for from block i on, either way, among blocks `lowest` to
  /// `highest`.
  std::size_t block_at(double s, std::size_t i, std::size_t lowest,
                       std::size_t highest) const noexcept;

 private:
  SlidingVector<Vertex> vertices_;
};

}  // namespace twin::smoothing
