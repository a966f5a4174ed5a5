#pragma once

#include <array>
#include <optional>
#include <string>

#include "studies/circular/deviations.hpp"
#include "studies/circular/reversal_spikes.hpp"

namespace twin::studies::circular {

/// What was measured at one place: by the table's true position, or by its encoders.
struct Measured {
  Deviations deviations;
  std::array<ReversalSpikes, 2> spikes;  ///< counter-clockwise, clockwise
};

/// Everything the circular test found.
struct Report {
  std::string machine;              ///< name of the machine file
  std::string hal;                  ///< "mujoco", "ideal"
  std::string interpolator;         ///< "nurbs", "linear"
  double period = 0.001;            ///< [s]
  double radius = 0.0;              ///< nominal [mm]
  double feedrate = 0.0;            ///< programmed [mm/s]
  std::array<double, 2> reached{};  ///< mean feedrate of the set points, each sense [mm/s]
  Measured table;                   ///< true position, as a ballbar sees it
  Measured encoder;                 ///< as the controller sees it
  std::optional<double> predicted;  ///< mean radial deviation after Eq. 3 [mm]
  std::string no_prediction;        ///< why there is none
};

/// Text of circle.json: keys in a fixed order, 9 significant digits.
std::string to_json(const Report& report);

/// The table for the terminal.
std::string to_table(const Report& report);

}  // namespace twin::studies::circular
