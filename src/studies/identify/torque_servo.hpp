#pragma once

#include <vector>

#include "studies/identify/axis_fit.hpp"
#include "studies/identify/axis_problem.hpp"

namespace twin::studies::identify {

/// Fits the law of a servo whose drive is in torque mode to the recorded drive commands:
///   s V_k = Kp e_k - Kv w_k + Kf v_k + Ka a_k + s V_trim,   w_k = (y_k - y_{k-n}) / (n T).
///
/// The scale s is chosen so that Kv = 1, unless V-REF scale is fixed; n is the one of 1 to 8 periods
/// that fits best. Kf and Ka are fitted where they make the rest much smaller. The machine gets the
/// gains.
/// @returns a parameter for each gain
std::vector<FittedParameter> measure_torque_servo(const AxisProblem& problem,
                                                  const FitOptions& options,
                                                  config::MachineFile& machine);

/// The steady tracking error for each unit of velocity, by linear least squares of
///   e = L v + A a + c sgn v + d,
/// which is (1 - Kf) / Kp of a servo whose drive follows its speed command. Without drive commands
/// this ratio is all that a record shows of Kp and Kf. Its deviation includes 2 % of L, which a
/// velocity loop without an integral part may add by its friction.
FittedParameter measure_velocity_lag(const AxisProblem& problem);

}  // namespace twin::studies::identify
