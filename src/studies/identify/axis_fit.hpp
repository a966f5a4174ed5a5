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
#include "studies/identify/inverse_model.hpp"

namespace twin::studies::identify {

/// Options of a fit.
struct FitOptions {
  std::size_t evaluations = 1200;  ///< number of simulations in the global search, for each axis
  std::uint32_t seed = 1;
  std::vector<std::string> fixed;  ///< keys that keep the starting value
  std::vector<std::string> freed;  ///< keys that are fitted although they are fixed by default
  double held_out_share = 0.0;     ///< of each record, at its end, that joins the fit last
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
  kIdentified,    ///< the fit found it, and the data determine it
  kUncertain,     ///< the fit found it, but its deviation is not to be trusted, or large
  kMeasured,      ///< computed from the data directly, without a fit
  kUnidentified,  ///< starting value, because the data do not determine it
  kAtBound,       ///< starting value, because the fit ran to the end of the parameter's range
  kFixed,         ///< starting value, because the user wanted so
};

/// One parameter of the result.
struct FittedParameter {
  std::string key;
  std::string name;
  double start = 0.0;  ///< in the key's unit
  double value = 0.0;  ///< in the key's unit
  /// Standard deviation of the fitted value, in the key's unit. For an unidentified parameter it is
  /// the one that the fitted value would have had.
  double sigma = 0.0;
  double relative = 0.0;  ///< sigma divided by the value, or by its typical size if that is larger
  Verdict verdict = Verdict::kIdentified;
  std::string why;  ///< why a parameter is unidentified
};

/// A residual of so many times what rounding makes is a lack of fit: deviations say too little then.
inline constexpr double kLackOfFit = 3.0;

/// Result of fitting one axis.
struct AxisFit {
  config::MachineFile machine;  ///< the starting machine with the new values of this axis
  std::vector<FittedParameter> parameters;
  std::vector<FittedParameter> derived;    ///< what is no key of its own; its unit is in the name
  std::vector<std::string> notes;          ///< of the fit
  std::vector<std::string> seems_to_lack;  ///< what the residual goes with, where it is too large
  std::string would_explain;  ///< a feature that the model lacks and what it would explain of that
  std::optional<InverseModel> inverse;  ///< where the motor's force is known
  std::optional<InverseModel> two_way;  ///< the same with friction that differs either way
  bool takes_two_way = false;           ///< the machine has the friction of the latter
  /// The machine before the held-out part of the records joined the fit.
  std::optional<config::MachineFile> trained;
  std::optional<InverseModel> trained_inverse;
  bool turns_force = false;     ///< the recorded force counts the other way than the position
  double residual_rms = 0.0;    ///< RMS of the open-loop residual; in torque mode closed-loop [mm]
  double rounding_rms = 0.0;    ///< RMS of the encoder's rounding, 1 count / sqrt(12) [mm]
  double scale_rms = 0.0;       ///< RMS of what is left of scales on the table; 0: none [mm]
  std::size_t evaluations = 0;  ///< number of simulations in the global search
  bool was_stopped = false;

  /// The inverse model whose friction the machine has.
  const std::optional<InverseModel>& used_inverse() const {
    return takes_two_way ? two_way : inverse;
  }
};

/// Fits one axis in four steps: direct estimates from the data, a global search (CMA-ES), a local
/// one (Levenberg-Marquardt), and a verdict on each parameter from its standard deviation.
AxisFit fit_axis(AxisProblem problem, const FitOptions& options);

}  // namespace twin::studies::identify
