#pragma once

#include "core/vec.hpp"

namespace twin {

/// What the machine may be asked to do along its path.
struct Limits {
  double feedrate = 200.0;                 ///< largest feedrate the machine accepts [mm/s]
  double rapid_feedrate = 100.0;           ///< feedrate of G00 [mm/s]
  double acceleration = 2450.0;            ///< A_max, tangential and normal, each [mm/s^2]
  double jerk = 50000.0;                   ///< J_max, tangential [mm/s^3]
  Vec3 travel_min{-200.0, -200.0, -60.0};  ///< lower ends of travel (x, y, z) [mm]
  Vec3 travel_max{200.0, 200.0, 60.0};     ///< upper ends of travel (x, y, z) [mm]
};

/// The first-order servo model that the planner believes in (Eqs. 1, 4, 16 of the paper).
///
/// These are the planning gains; the loop that runs has servo gains of its own (servo::Gains).
struct PlanningModel {
  double kp = 207.207;            ///< position gain Kp [1/s]
  double kf = 0.34;               ///< velocity feedforward gain Kf, 0 <= Kf < 1 [-]
  double circular_error = 0.005;  ///< circular contouring error eps_ss of Eq. 4 [mm]
  double corner_error = 0.01;     ///< corner error eps_max of Eqs. 1, 16 [mm]
};

}  // namespace twin
