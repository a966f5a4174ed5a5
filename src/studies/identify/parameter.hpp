#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::studies::identify {

/// How the range of a parameter is mapped to [0, 1].
enum class Scale {
  kLinear,
  kLogarithmic,  ///< equal ratios are equal steps; min > 0
};

/// A number of the machine file that is to be fitted, and the range of the search.
struct Parameter {
  std::string key;   ///< "table.x.coulomb_friction_N"; the unit may be left out
  double min = 0.0;  ///< lower end of the range, in the key's unit
  double max = 1.0;  ///< upper end of the range, in the key's unit
  Scale scale = Scale::kLinear;
};

/// Maps a value to its place in the range: 0 at min, 1 at max, below 0 or above 1 outside.
/// @param value  in the key's unit
double to_unit(const Parameter& parameter, double value);
/// The inverse of to_unit(). @returns the value, in the key's unit
double from_unit(const Parameter& parameter, double unit);

/// A list of parameters that turns a vector of numbers, as a search has it, into a machine file and
/// back.
///
/// Every number of the machine file can be a parameter; its key is that of config::bindings.
class ParameterSet {
 public:
  /// Finds the settings of the parameters.
  /// @returns kUsage error if a key does not exist, is not a number or is given twice, or if its
  ///          range is empty or not inside the range of the setting
  static Expected<ParameterSet> create(std::vector<Parameter> parameters);

  std::size_t size() const noexcept { return parameters_.size(); }
  const std::vector<Parameter>& parameters() const noexcept { return parameters_; }
  const Parameter& operator[](std::size_t i) const noexcept { return parameters_[i]; }

  /// Values that the parameters have in a machine, in the keys' units.
  std::vector<double> values(const config::MachineFile& machine) const;
  /// Returns the machine with other values of the parameters, in the keys' units, each clamped to
  /// the range of its setting.
  config::MachineFile with_values(const config::MachineFile& machine,
                                  std::span<const double> values) const;

  /// The same two functions with values mapped to [0, 1] and clamped to the range of the parameter.
  std::vector<double> units(const config::MachineFile& machine) const;
  config::MachineFile with_units(const config::MachineFile& machine,
                                 std::span<const double> units) const;

 private:
  std::vector<Parameter> parameters_;
  std::vector<std::size_t> bindings_;  // place of each in config::bindings
};

}  // namespace twin::studies::identify
