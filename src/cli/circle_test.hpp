#pragma once

#include <filesystem>

#include "cli/options.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::cli {

/// What a circular test runs, in base units.
struct CircleTest {
  config::MachineFile machine;
  double radius = 0.0;           ///< of the circle about X0 Y0 [mm]
  double feedrate = 0.0;         ///< programmed [mm/s]
  std::filesystem::path folder;  ///< of the results
};

/// The test that the options ask for, held against the machine's travel and largest feedrate.
Expected<CircleTest> make_circle_test(const Options& options);

}  // namespace twin::cli
