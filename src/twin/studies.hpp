#pragma once

#include <atomic>
#include <string>

#include "twin/export.hpp"
#include "twin/program.hpp"
#include "twin/settings.hpp"

namespace twin {

/// How a circular test is done.
struct CircleOptions {
  double radius = 20.0;                     ///< of the circle about X0 Y0 [mm]
  double feedrate = 50.0;                   ///< programmed [mm/s]
  std::string folder{};                     ///< gets programs, traces, summaries and circle.json
  const std::atomic<bool>* stop = nullptr;  ///< ends it early when another thread sets it
};

/// What a circular test has found.
struct Circle {
  std::string table;  ///< what `twin circle` prints
  std::string json;   ///< the text of circle.json
};

/// Runs a circle in both senses on the simulated table and evaluates it in the terms of ISO 230-4:
/// circular and radial deviations, reversal spikes.
///
/// @throws Failure if the options are none for this machine, if there is no folder, or if a run
///         fails
TWIN_EXPORT Circle circle(const Settings& settings, const CircleOptions& options);

/// A program in the dialect of another control.
struct Converted {
  std::string text;   ///< the new program
  std::string table;  ///< what `twin convert` prints
};

/// Fits the short blocks of a program by NURBS, writes it in a dialect, reads it back and holds it
/// against the original.
///
/// @param dialect  "g5.2", "g6.2", "fanuc" or "bspline"
/// @throws Failure if the program has an error, the dialect is unknown or cannot have a curve of it
TWIN_EXPORT Converted convert(const Program& program, const Settings& settings,
                              const std::string& dialect);

}  // namespace twin
