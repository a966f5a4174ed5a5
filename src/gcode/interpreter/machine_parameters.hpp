#pragma once

#include <optional>
#include <string_view>

#include "gcode/values/parameter_source.hpp"

namespace twin::gcode {

class Interpreter;

/// The parameters that a control supplies by itself, from the state of the interpreter:
/// position, offsets and modal state. Lengths
/// of 5161 to 5410 are in mm whatever the program's units, as a control keeps them in its own.
class MachineParameters final : public ParameterSource {
 public:
  /// @param interpreter  must outlive this object
  explicit MachineParameters(Interpreter& interpreter) : interpreter_(&interpreter) {}

  std::optional<double> numbered(int number) const override;
  std::optional<double> named(std::string_view name) const override;
  bool set(int number, double value) override;

 private:
  Interpreter* interpreter_;
};

}  // namespace twin::gcode
