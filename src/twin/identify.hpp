#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "twin/export.hpp"
#include "twin/settings.hpp"

namespace twin {

/// How a machine is identified.
struct IdentifyOptions {
  /// Which columns of the traces are which signal, "SIGNAL=COLUMN[:UNIT],..." as --columns has it;
  /// empty: those of a trace of `twin run`.
  std::string columns{};
  std::vector<std::string> fixed{};  ///< keys that keep their value, with their unit or without
  std::vector<std::string> freed{};  ///< keys that are fitted though they would be held
  /// Further traces, recorded with the encoder at the table in place of the motor: with the others
  /// they tell the screw's stiffness and play.
  std::vector<std::string> at_table{};
  /// Recordings that are predicted only, in the same columns; empty: the last 30 % of each trace.
  std::vector<std::string> validating{};
  std::size_t evaluations = 0;  ///< simulations of the global search; 0: as many as usual
  std::uint32_t seed = 1;       ///< of the global search; the same seed gives the same result
  /// Ends the fit early with a Failure of kInterrupted when another thread sets it; may be null.
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress{};  ///< gets the done share, 0 to 1; may be empty
};

/// What the identified machine predicts of one axis of a recording that was not fitted.
struct Validation {
  std::string trace;          ///< name of its file
  std::string axis;           ///< "x" or "y"
  bool is_held_out = false;   ///< the end of a trace whose begin was fitted
  double tracking_rms = 0.0;  ///< set point less measured position [mm]
  double twin_rms = 0.0;      ///< measured less simulated position [mm]
  double twin_max = 0.0;      ///< the same, largest [mm]
  double delay_rms = 0.0;     ///< measured less the set point a fitted time ago [mm]
  double filter_rms = 0.0;    ///< measured less a fitted filter of 10 taps of the set points [mm]
  /// Recorded less simulated force of the motor over the recorded one, RMS; below 0 where no force
  /// was recorded.
  double force_error = -1.0;
};

/// What recordings say of a machine.
struct Identification {
  Settings settings;  ///< those of the start with everything that was identified
  std::string toml;   ///< the same as a machine file that says where each value is from
  std::string table;  ///< what `twin identify` prints
  std::string json;   ///< parameters, predictions and verdicts as identify.json has them
  std::vector<Validation> validations{};  ///< of what was not fitted
  std::vector<std::string> notes;         ///< what was noticed and let pass
};

/// Fits a machine's parameters to traces recorded on it.
///
/// @param traces  CSV files with even time, set points and measured positions
/// @param start   settings that the search begins at, and that what is not identified keeps
/// @throws Failure if a trace cannot be read or cannot be what it claims to be, or if a key is
/// nothing that a trace is fitted for; it names the nearest one that is
TWIN_EXPORT Identification identify(const std::vector<std::string>& traces, const Settings& start,
                                    const IdentifyOptions& options = {});

}  // namespace twin
