#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::studies::identify {

/// How a parameter's range is mapped on [0, 1].
enum class Scale {
  kLinear,
  kLogarithmic,  ///< equal ratios are equal steps; min > 0
};

/// A number of the machine file that may be fitted: its key and the range to look in.
struct Parameter {
  std::string key;   ///< "table.x.coulomb_friction_N"; the unit may be left out
  double min = 0.0;  ///< in the key's unit
  double max = 1.0;  ///< in the key's unit
  Scale scale = Scale::kLinear;
};

/// Place of a value in its range, 0 at min and 1 at max; outside of the range beyond these.
double to_unit(const Parameter& parameter, double value);
/// Value at a place in the range, in the key's unit.
double from_unit(const Parameter& parameter, double unit);

/// Parameters found among the settings of a machine file: vectors of numbers in, machine files out.
///
/// Keys are those of config::bindings, so whatever the machine file has can be fitted.
class ParameterSet {
 public:
  /// Looks the keys up. @returns kUsage error for a key that does not exist, is no number, is named
  /// twice, or whose range is empty or not inside that of the setting
  static Expected<ParameterSet> create(std::vector<Parameter> parameters);

  std::size_t size() const noexcept { return parameters_.size(); }
  const std::vector<Parameter>& parameters() const noexcept { return parameters_; }
  const Parameter& operator[](std::size_t i) const noexcept { return parameters_[i]; }

  /// Values of the machine, in the keys' units.
  std::vector<double> values(const config::MachineFile& machine) const;
  /// The machine with other values, in the keys' units, each limited to its setting's range.
  config::MachineFile with_values(const config::MachineFile& machine,
                                  std::span<const double> values) const;

  /// The same on [0, 1], limited to the parameters' ranges.
  std::vector<double> units(const config::MachineFile& machine) const;
  config::MachineFile with_units(const config::MachineFile& machine,
                                 std::span<const double> units) const;

 private:
  std::vector<Parameter> parameters_;
  std::vector<std::size_t> bindings_;  // place of each in config::bindings
};

}  // namespace twin::studies::identify
