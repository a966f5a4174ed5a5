#pragma once

#include <optional>
#include <string_view>

namespace twin::gcode {

/// What the control knows of itself and a program may ask for by a parameter: position, offsets,
/// modes. Everything else that a program writes with # is a plain variable of Parameters.
class ParameterSource {
 public:
  ParameterSource() = default;
  ParameterSource(const ParameterSource&) = default;
  ParameterSource& operator=(const ParameterSource&) = default;
  virtual ~ParameterSource() = default;

  /// Value of a parameter numbered 5000 or more, as #5420 (X of the position), in the program's
  /// units; nullopt where the control keeps nothing there and it is a plain variable.
  virtual std::optional<double> numbered(int number) const = 0;

  /// Value of a predefined name in lower case without # < >, as "_x"; nullopt for other names.
  virtual std::optional<double> named(std::string_view name) const = 0;

  /// Takes a value that a program gives to a parameter numbered 5000 or more, as #5221 (X of the
  /// first work offset). @returns false where the control keeps nothing there
  virtual bool set(int number, double value) = 0;
};

}  // namespace twin::gcode
