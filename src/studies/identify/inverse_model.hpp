#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "studies/identify/axis_record.hpp"

namespace twin::studies::identify {

/// A coefficient of the inverse model.
struct Coefficient {
  double value = 0.0;
  double sigma = 0.0;  ///< standard deviation, with what the model lacks
};

/// Mass and friction of an axis by linear least squares from the force of its motor:
///   F = M a + Fv v + dFv |v| + Fc sgn v + W.                                                  (1)
/// Position and force are smoothed alike, so that the smoothing changes no coefficient [Gautier
/// 1997]; a and v are differences of the smoothed position. Rows at rest are left out, where
/// friction is any force below breakaway. With dFv = 0 friction is the same either way.
struct InverseModel {
  Coefficient mass;               ///< M, the rotor's included [kg]
  Coefficient viscous;            ///< Fv [N s/mm]
  Coefficient viscous_asymmetry;  ///< dFv: Fv + dFv towards plus, Fv - dFv towards minus [N s/mm]
  Coefficient coulomb;            ///< Fc [N]
  Coefficient weight;             ///< W [N]
  double relative_error = 0.0;    ///< RMS of what (1) leaves, over the RMS of F [-]
  double force_rms = 0.0;         ///< of the rows in motion [N]
  bool is_two_way = false;        ///< dFv is fitted, too
  bool has_both_directions = false;
  std::size_t rows = 0;                    ///< in motion
  std::vector<std::string> seems_to_lack;  ///< what the residual goes with

  /// F at a motion [N]. @param a  [mm/s^2]  @param v  [mm/s]
  double force(double a, double v) const noexcept;
};

/// Whether friction is fitted separately for both directions.
enum class Directions { kAlike, kTwoWay };

/// Fits (1) to records with force.
///
/// A coefficient's deviation is that of scores summed over blocks of 0.25 s, and beside it what the
/// coefficient changes by at most with other models and other rows: friction in two ways, a Stribeck
/// term, only the faster rows, a longer smoothing, the force some rows earlier or later.
/// @param quantum  of the position, 0: none; the smoothing grows where its noise would show [mm]
InverseModel fit_inverse_model(std::span<const AxisRecord> records, double period, double quantum,
                               Directions directions);

/// RMS of recorded force less that of a model over the RMS of the force, in motion [-].
double force_error(const InverseModel& model, std::span<const AxisRecord> records, double period,
                   double quantum);

}  // namespace twin::studies::identify
