#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "studies/compensate/model_run.hpp"
#include "studies/identify/parameter.hpp"

/// What may come of a run before it is made.
namespace twin::studies::predict {

/// A machine as it may be, and the phases that it may have.
struct PossibleMachine {
  config::MachineFile machine;
  compensate::Phases phases;
};

/// How well the parameters of a table are known.
///
/// Where twin identify has left identify.json beside the machine file, the deviations of the
/// parameters that it has found are those of that file. All others, and those of a machine without
/// such a file, are the shares of [uncertainty] in the machine file. Parameters are taken to be
/// independent and normally distributed, cut off at three deviations.
class Uncertainty {
 public:
  static Expected<Uncertainty> of(const config::MachineFile& machine);

  /// Machine number `index`: the same for the same seed, whatever was drawn before.
  PossibleMachine draw(std::uint64_t seed, std::uint64_t index) const;

  /// Keys of the parameters, and their deviations in the keys' units.
  const std::vector<std::string>& keys() const noexcept { return keys_; }
  const std::vector<double>& deviations() const noexcept { return deviations_; }
  /// Number of the deviations that identify.json gave.
  std::size_t measured() const noexcept { return measured_; }

 private:
  Uncertainty(config::MachineFile machine, identify::ParameterSet parameters)
      : machine_(std::move(machine)), parameters_(std::move(parameters)) {}

  config::MachineFile machine_;
  identify::ParameterSet parameters_;
  std::vector<std::string> keys_;
  std::vector<double> deviations_;
  std::size_t measured_ = 0;
};

}  // namespace twin::studies::predict
