#pragma once

namespace twin::motion {

/// Gains of one axis of the position loop that runs (not the planning gains).
///
/// Command velocity u = Kp e + Kd de/dt + Kf v + Ka a with e = set point less measured, v and a of
/// the set point; the drive command is u over the V-REF scale, plus a trim.
struct Gains {
  double kp = 150.0;    ///< position gain [1/s]
  double kd = 0.0;      ///< derivative gain [-]
  double kf = 1.0;      ///< velocity feedforward [-]
  double ka = 0.0;      ///< acceleration feedforward [s]
  double trim_V = 0.0;  ///< added to the drive command against the drive's offset [V]
};

}  // namespace twin::motion
