#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "twin/export.hpp"
#include "twin/program.hpp"
#include "twin/settings.hpp"

namespace twin {

/// How a correction is made.
struct CompensationOptions {
  /// Ends it early with a Failure of kInterrupted when another thread sets it; may be null.
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress{};  ///< gets the done share, 0 to 1; may be empty
};

/// What the model of a machine expects of a correction: contour errors of the table, of the mean
/// over phases of encoder and hum.
struct Compensation {
  double max_before = 0.0;  ///< largest, without the correction [mm]
  double max_after = 0.0;   ///< with it [mm]
  double rms_before = 0.0;  ///< root mean square, without the correction [mm]
  double rms_after = 0.0;   ///< with it [mm]
  int iterations = 0;       ///< on the model
};

/// Finds the shifts of the set points by which the identified table meets the programmed path, and
/// writes them to a file that RunOptions::correction takes.
///
///     twin::compensate(program, settings, "dolphin.csv");
///     const twin::Run run = twin::run(program, settings, *table, {.correction = "dolphin.csv"});
///
/// The file belongs to this program, its feedrate and these settings; a run refuses it for any other.
/// To learn from measured runs there is RunOptions::learning.
/// @throws Failure if the table was never identified, if the program cannot be planned, or if the
///         file cannot be written
TWIN_EXPORT Compensation compensate(const Program& program, const Settings& settings,
                                    const std::string& file,
                                    const CompensationOptions& options = {});

}  // namespace twin
