#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "motion/interpolator/set_point.hpp"
#include "studies/compensate/band_matrix.hpp"
#include "studies/compensate/loop_response.hpp"

namespace twin::studies::compensate {

/// Finds the change of the offsets that the model expects to undo a contour error best.
///
/// With the offsets o, the error vectors e, the response G of the axes (a filter each) and the
/// matrix P_k = n n' + kAlong^2 t t' of each period, with normal n and tangent t of the path, the
/// change d minimises
///   sum_k |P_k^(1/2) (e_k - (G d)_k)|^2
///     + sum_k |W (o + d)'''_k|^2 + sum_k j_k (t_k (o + d)'''_k)^2 + sum_k a_k (n_k (o + d)''_k)^2
/// where ' is the difference over a period. A contour error is normal to the path, so the offsets
/// along the path are free; what they are good for is the next corner, whose normal they become.
/// W = (2 pi f)^-3 ends the correction at the frequency f of each axis. The weights j_k and a_k hold
/// tangential jerk and normal acceleration, and are raised where a limit would not be kept.
/// An axis that stands still is held by its friction and answers to a lasting offset only, so that
/// offsets which change there are penalised as well, by sum_k (o + d)'_k^2 / (2 pi f_s T)^2.
///
/// The normal equations are solved by conjugate gradients, with G left out of the preconditioner.
class OffsetSolver {
 public:
  /// @param responses  G of x and y, filters that reach both ways
  /// @param cut_off    f of x and y [Hz]
  OffsetSolver(std::span<const motion::SetPoint> points, double period,
               const std::array<Filter, 2>& responses, const std::array<double, 2>& cut_off);

  /// Lets the error along the path count where it has one: beyond a corner the nearest point of the
  /// path is the corner itself, and the way back to it is not normal to the path.
  void note_corners(std::span<const Vec2> errors);
  /// Changes offsets by what undoes these errors. @param errors  (periods) [mm]
  void improve(std::span<const Vec2> errors, std::vector<Vec2>& offsets) const;

  /// Lowers j_k and a_k, j_k not below what it was at first: what held earlier offsets may be more
  /// than later ones need.
  void relax();
  /// Multiplies j_k and a_k by factors of at least 1, one a period.
  void hold(std::span<const double> tangential, std::span<const double> normal);

 private:
  void prepare();
  void add_weights();
  std::vector<double> responded(std::span<const double> offsets) const;
  std::vector<double> responded_back(std::span<const double> errors) const;
  std::vector<double> weighted(std::span<const double> errors) const;

  double period_;                       // T [s]
  std::array<Filter, 2> responses_;     // G
  std::array<double, 2> smoothness_{};  // W^2
  std::array<std::vector<bool>, 2> stands_;
  std::vector<Vec2> tangents_;
  std::vector<bool> is_free_along_;  // whether the error along the path is left out
  double least_tangential_ = 0.0;    // j_k to begin with
  std::vector<double> sideways_;     // share of j_k that holds the normal direction
  std::vector<double> tangential_;   // j_k
  std::vector<double> normal_;       // a_k
  BandMatrix penalty_;
  BandMatrix preconditioner_;  // its factors
};

}  // namespace twin::studies::compensate
