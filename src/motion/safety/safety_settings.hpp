#pragma once

namespace twin::motion {

/// Limits of the monitors, the same for both axes; section [safety] of the machine file.
struct SafetySettings {
  double tracking_error = 0.5;                ///< limit at rest [mm]
  double tracking_error_per_feedrate = 0.02;  ///< added per feedrate [mm/(mm/s) = s]
  double tracking_filter_time = 0.01;         ///< how long it may be exceeded [s]
  double runaway = 0.1;                       ///< tracking error that a wrong sign may make [mm]
  double runaway_per_feedrate = 0.002;        ///< added per feedrate [mm/(mm/s) = s]
  double frozen_encoder = 0.3;      ///< way of the command that must change the counts [mm]
  double count_step_ratio = 3.0;    ///< fastest plausible counts over the largest feedrate [-]
  double saturation_time = 0.05;    ///< how long a drive command may be cut to +-10 V [s]
  double heartbeat_timeout = 0.02;  ///< longest silence before the guard acts [s]
  double ready_timeout = 3.0;       ///< from servo on to servo ready at the latest [s]
};

}  // namespace twin::motion
