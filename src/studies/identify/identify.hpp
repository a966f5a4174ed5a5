#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "results/metrics/summary.hpp"
#include "studies/identify/axis_fit.hpp"
#include "studies/identify/recording.hpp"
#include "studies/identify/validation.hpp"

namespace twin::studies::identify {

/// Tracking error of one axis in one trace, measured and of the identified machine in closed loop.
struct Prediction {
  std::string trace;
  hal::Axis axis = hal::kX;
  results::ErrorStats measured;
  results::ErrorStats simulated;
};

/// What recordings say of a machine.
struct Identification {
  config::MachineFile machine;  ///< the start with everything that was identified
  std::array<std::optional<AxisFit>, hal::kServoAxes> axis;  ///< nothing for one that did not move
  std::vector<Prediction> predictions;
  std::vector<Validation> validations;  ///< of what was not fitted
  std::vector<std::string> notes;
  bool has_volts = false;
};

/// Fits both axes of a machine to recordings, at the same time.
///
/// All recordings must have one period, which becomes that of the machine; either all or none have
/// the drive command of an axis, else it is not used.
/// Where no recordings are given to validate with, the last 30 % of each recording are held out: the
/// search does not see them, the machine that it finds predicts them, and then they join the fit.
/// @param start       machine file whose values the search begins at and unidentified parameters keep
/// @param validating  recordings that are predicted only
Expected<Identification> identify(const std::vector<Recording>& recordings,
                                  const config::MachineFile& start, const FitOptions& options,
                                  const std::vector<Recording>& validating = {});

}  // namespace twin::studies::identify
