#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motion/motion_settings.hpp"
#include "studies/identify/axis_fit.hpp"
#include "studies/identify/axis_problem.hpp"
#include "studies/identify/quantum.hpp"

namespace twin::studies::identify {

/// Gains of the position loop and their standard deviations, from recorded drive commands.
struct GainFit {
  motion::Gains gains;
  motion::Gains sigma;
  double rms_V = 0.0;  ///< what the law of the servo leaves unexplained [V]
};

/// Linear least squares of s V_k = Kp e_k + Kd (e_k - e_{k-1}) / T + Kf v_k + Ka a_k + s V_trim.
///
/// Rows at the limit of +-10 V are left out. Every record must have volts.
/// @param mm_per_s_per_volt  V-REF scale s [mm/s/V]  @param period  T [s]
GainFit fit_gains(std::span<const AxisRecord> records, double mm_per_s_per_volt, double period);

/// Reads the encoder's count off the first record. Where the record shows it, the machine gets it.
FittedParameter measure_count(const AxisProblem& problem, const FitOptions& options,
                              config::MachineFile& machine);

/// Fits the servo's gains to the recorded drive commands. The machine gets those that the commands
/// show.
///
/// @returns a parameter for each gain; none where the drive commands were not recorded
std::vector<FittedParameter> measure_gains(const AxisProblem& problem, const FitOptions& options,
                                           config::MachineFile& machine);

}  // namespace twin::studies::identify
