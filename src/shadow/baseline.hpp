#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"
#include "shadow/count_filter.hpp"
#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// What the healthy machine makes of one channel of one axis.
struct ChannelBaseline {
  ChannelKind kind = ChannelKind::kPosition;
  std::vector<double> coefficients;  ///< of the whitening filter
  double variance = 1.0;             ///< of the whitened residual
  CountNoise noise;                  ///< of kCounts, in place of filter and variance
  PerParameter mean{};               ///< parameters of the healthy machine less the model's
  PerParameter excess{};             ///< scores vary so much more than white noise would make, >= 1
  PerParameter limit{};              ///< largest change that is plausible
  PerParameter
      scatter{};  ///< deviation of the parameter from window to window, whatever their length
  double step_excess = 1.0;   ///< gains by lost counts are so much larger than white noise makes
  double force_excess = 1.0;  ///< the same of a force that begins
  std::size_t windows = 0;    ///< that this was learnt from; 0: nothing was learnt
};

/// What all of this was learnt from and is for.
struct Baseline {
  std::array<std::vector<ChannelBaseline>, hal::kServoAxes> axis;
  double period = 0.001;              ///< [s]
  std::string machine;                ///< name, for messages
  std::string machine_sha256;         ///< of the settings of the table and the period
  std::vector<std::string> programs;  ///< names of the traces, for readers
  double seconds = 0.0;               ///< of motion, of all axes
};

/// Hash of what a shadow's model is made of: the table's settings without the phases of encoder and
/// hum, and the period.
std::string hash_of_model(const config::MachineFile& machine);

/// Writes what was learnt as JSON.
Expected<void> write_baseline(const std::filesystem::path& file, const Baseline& baseline);

/// Reads it back.
/// @returns an error that names file and line, or what the file was learnt of, where it is not for
///          this machine and period
Expected<Baseline> read_baseline(const std::filesystem::path& file,
                                 const config::MachineFile& machine);

}  // namespace twin::shadow
