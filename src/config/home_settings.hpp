#pragma once

namespace twin::config {

/// Where an axis has its home, section [home.x] of the machine file.
struct HomeSettings {
  bool is_positive = false;     ///< home switch is P-OT; else N-OT
  double seek_feedrate = 10.0;  ///< towards the switch, and to zero afterwards [mm/s]
  double index_feedrate = 1.0;  ///< off the switch and to the index [mm/s]
  double zero = 0.0;            ///< from the index to the axis' zero, signed [mm]
};

}  // namespace twin::config
