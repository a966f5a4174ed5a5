#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/identify/axis_problem.hpp"
#include "studies/identify/candidates.hpp"

namespace twin::studies::identify {

/// How to fit.
struct FitOptions {
  std::size_t evaluations = 1200;  ///< simulations of the global search, an axis
  std::uint32_t seed = 1;
  std::vector<std::string> fixed;  ///< keys that keep the starting value
  std::vector<std::string> freed;  ///< keys that are fitted though they would be held
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress;  ///< gets the done share, 0 to 1

  bool is_fixed(const std::string& key) const {
    return std::find(fixed.begin(), fixed.end(), key) != fixed.end();
  }
  bool is_freed(const std::string& key) const {
    return std::find(freed.begin(), freed.end(), key) != freed.end();
  }
};

/// Where the value of a parameter comes from.
enum class Verdict {
  kIdentified,    ///< fitted; the data show it
  kMeasured,      ///< read off the data directly
  kUnidentified,  ///< the data do not show it: starting value
  kAtBound,       ///< the data push it out of its range: starting value
  kFixed,         ///< the user wanted the starting value
};

/// One parameter of the result.
struct FittedParameter {
  std::string key;
  std::string name;
  double start = 0.0;  ///< in the key's unit
  double value = 0.0;  ///< in the key's unit
  /// Standard deviation, in the key's unit. For an unidentified parameter it is the one that a fit
  /// would have had.
  double sigma = 0.0;
  double relative = 0.0;  ///< sigma over the value, or over its natural size
  Verdict verdict = Verdict::kIdentified;
  std::string why;  ///< of an unidentified one
};

/// What the records say of one axis.
struct AxisFit {
  config::MachineFile machine;  ///< the start with the values of this axis
  std::vector<FittedParameter> parameters;
  double residual_rms = 0.0;  ///< of the open-loop residual [mm]
  double rounding_rms = 0.0;  ///< that the encoder's rounding alone makes, quantum / sqrt(12) [mm]
  std::size_t evaluations = 0;  ///< simulations of the global search
  bool was_stopped = false;
};

/// Fits one axis: direct estimates, CMA-ES, Levenberg-Marquardt, and what the data show.
AxisFit fit_axis(AxisProblem problem, const FitOptions& options);

}  // namespace twin::studies::identify
