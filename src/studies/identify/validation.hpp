#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/metrics/summary.hpp"
#include "studies/identify/axis_fit.hpp"

namespace twin::studies::identify {

/// How a signal of a motion was predicted that the fit has not seen: measured less simulated.
struct SignalErrors {
  double measured_rms = 0.0;  ///< of the signal itself
  results::ErrorStats twin;
  std::optional<double> rigid_body_rms;  ///< by a rigid body with Coulomb and viscous friction
};

/// The prediction of one axis in one trace, beside baselines that were fitted to the same data.
struct Validation {
  std::string trace;
  hal::Axis axis = hal::kX;
  bool is_held_out = false;           ///< the end of a trace whose begin was fitted
  std::size_t first_row = 0;          ///< of the trace
  results::ErrorStats tracking;       ///< set point less measured [mm]
  results::ErrorStats twin;           ///< measured less simulated in closed loop [mm]
  results::ErrorStats delay;          ///< measured less delayed set point [mm]
  results::ErrorStats filter;         ///< measured less set point behind a filter of 10 taps [mm]
  double delay_time = 0.0;            ///< [s]
  std::optional<SignalErrors> volts;  ///< [V]
  std::optional<SignalErrors> force;  ///< in closed loop [N]
  std::optional<double> inverse_force_error;  ///< relative, of the inverse model [-]
  /// For the figure: time [s], measured less simulated, less filter, less delay [um].
  std::vector<std::array<double, 4>> curves;
};

/// Predicts a record.
/// @param machine  that the fit has made
/// @param inverse  of the same fit, where the force is known
/// @param trained  the records that were fitted, for the baselines
Validation validate(const AxisRecord& record, hal::Axis axis, const config::MachineFile& machine,
                    const std::optional<InverseModel>& inverse,
                    std::span<const AxisRecord> trained);

}  // namespace twin::studies::identify
