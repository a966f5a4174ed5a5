#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/row_algebra.hpp"
#include "core/vec.hpp"
#include "path/corner/half_corner.hpp"

namespace twin::path {

/// The convex program, in units in which the tolerance and the least jerk are 1.
class HalfCornerProgram {
 public:
  static constexpr int kPieces = static_cast<int>(HalfCorner::kPieces);

  /// Unknowns: the velocity along x, the place and the acceleration along y at t = 0, and the jerks.
  static constexpr std::size_t kUnknowns = 3 + 2 * HalfCorner::kPieces;
  static constexpr std::size_t kEnds = 5;                  // conditions at t = T
  static constexpr std::size_t kFree = kUnknowns - kEnds;  // coordinates that the conditions leave
  using Row = std::array<double, kUnknowns>;

  /// @param demand    in those units; its tolerance is the share that may be used
  /// @param duration  in those units
  HalfCornerProgram(const CornerDemand& demand, double duration);

  /// Keeps the jerk of the path at the places of each piece as well, with the direction and the normal
  /// acceleration that another motion has there.
  void keep_path_jerk(const Row& other, double limit);

  /// Finds the solution. @returns false where there is none
  bool solve();
  /// The unknowns of the solution: the velocity along x, the place and the acceleration along y at
  /// t = 0, then the jerks along x, then along y.
  Row unknowns() const {
    Row all = base_;
    for (std::size_t i = 0; i < kFree; ++i) {
      add_to(all, at_[i], null_[i]);
    }
    return all;
  }

 private:
  using Free = std::array<double, kFree>;
  using Point = std::array<double, kFree + 1>;  // free coordinates, then the excess
  using Square = SquareMatrix<kFree + 1>;

  /// A limit |q| <= 1 + excess, with q linear in the free coordinates.
  struct Disc {
    std::array<Free, 2> slope;
    Vec2 offset;
    bool is_strip;  // the second component is none

    Vec2 at(const Point& point) const {
      return {offset.x() + product(slope[0], point), offset.y() + product(slope[1], point)};
    }
  };

  Row coordinate(int axis, int derivative, double t) const;
  Row along(int derivative, double t) const {
    Row row{};
    add_to(row, cos_, coordinate(0, derivative, t));
    add_to(row, sin_, coordinate(1, derivative, t));
    return row;
  }
  Row across(int derivative, double t) const {
    Row row{};
    add_to(row, cos_, coordinate(1, derivative, t));
    add_to(row, -sin_, coordinate(0, derivative, t));
    return row;
  }
  /// A function of the unknowns as one of the free coordinates.
  Free of_free(const Row& row, double factor) const {
    Free free;
    for (std::size_t i = 0; i < kFree; ++i) {
      free[i] = factor * product(row, null_[i]);
    }
    return free;
  }
  void keep_ends();
  void add_limits(const CornerDemand& demand);
  void add_axes(const CornerDemand& demand, double CornerAxis::*limit, const Row& x, const Row& y,
                double most);
  void add(const Row& x, const Row& y, double limit);
  bool find_inside();
  double value(const Point& at, double weight) const;
  bool step(double weight, std::size_t count);

  double cos_;
  double sin_;
  double feedrate_;
  double piece_;
  Row base_{};                     // unknowns that keep the ends
  std::array<Row, kFree> null_{};  // directions in which they stay kept, orthonormal
  Free way_{};
  std::vector<Disc> discs_;
  Point at_{};
};

}  // namespace twin::path
