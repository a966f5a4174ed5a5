#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "studies/compensate/contour_path.hpp"
#include "studies/predict/uncertainty.hpp"

namespace twin::studies::predict {

/// A question that need not try all machines: whether a share of them keeps a tolerance. Machines
/// that were the worst are tried first, and once too many have not kept it the others count as
/// unstable.
class Question {
 public:
  /// @param tolerance  [mm]
  Question(double tolerance, double share) : tolerance_(tolerance), share_(share) {}

  double tolerance() const noexcept { return tolerance_; }
  /// So many of the machines may be beyond the tolerance.
  std::size_t may_fail(std::size_t machines) const;
  /// Numbers of the machines in the order in which they are tried.
  std::vector<std::size_t> order(std::size_t machines) const;
  /// Remembers which were bad. @param largest  of each machine
  void learn(std::span<const double> largest);

 private:
  double tolerance_;
  double share_;
  std::vector<double> badness_;
};

/// How many machines are tried.
struct ToleranceOptions {
  std::size_t machines = 200;
  std::uint64_t seed = 1;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress{};  ///< gets the done share, 0 to 1; one call at a time
  Question* question = nullptr;            ///< that is asked; null: all errors are wanted
};

/// Contour errors of the table over possible machines, in feed motion: rapids do not count.
struct PossibleErrors {
  std::vector<double> largest;  ///< of each machine over the whole path; infinite: unstable [mm]
  /// Of each machine the largest on each stretch of path (machines x stretches) [mm].
  std::vector<std::vector<double>> on_stretch;
};

/// Runs a path on possible machines, on all cores; the result does not depend on their number.
///
/// @param offsets   correction of the set points, or none [mm]
/// @param stretches  number of the stretch that each period belongs to, from 0; may be empty
Expected<PossibleErrors> possible_errors(const compensate::ContourPath& path,
                                         const Uncertainty& uncertainty,
                                         std::span<const Vec2> offsets,
                                         std::span<const std::size_t> stretches,
                                         const ToleranceOptions& options);

/// With what probability the contour error of a run stays within a tolerance.
struct TolerancePrediction {
  double tolerance = 0.0;    ///< [mm]
  std::size_t within = 0;    ///< machines whose largest error is within it
  std::size_t machines = 0;  ///< that were tried
  double low = 0.0;          ///< of the probability, 95 % sure, by Wilson's interval
  double high = 1.0;         ///< the same
  double median = 0.0;       ///< of the largest errors [mm]
  double p95 = 0.0;          ///< 95 % of the machines stay within it [mm]

  double probability() const { return static_cast<double>(within) / static_cast<double>(machines); }
  /// "within 15 um with probability 0.93 (0.89 to 0.96; 200 machines, median 11.2 um, 95 % 16.1 um)"
  std::string text() const;
};

/// @param largest  errors of possible machines [mm]
TolerancePrediction predict(std::span<const double> largest, double tolerance);

/// The smallest error that a share of the machines stays within [mm].
double quantile(std::span<const double> errors, double share);

}  // namespace twin::studies::predict
