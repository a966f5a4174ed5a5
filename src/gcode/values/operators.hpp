#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/error.hpp"
#include "gcode/reader_options.hpp"

namespace twin::gcode {

enum class Operator : std::uint8_t {
  kNone,  ///< no operator stands there
  kPower,
  kTimes,
  kOver,
  kModulo,
  kPlus,
  kMinus,
  kEqual,
  kNotEqual,
  kGreater,
  kGreaterOrEqual,
  kLess,
  kLessOrEqual,
  kAnd,
  kOr,
  kXor,
};

/// Strength of an operator, 1 (AND) to 5 (**); 0 for none.
int strength(Operator op) noexcept;

/// Reads an operator at a place and steps over it; kNone steps over nothing.
Operator read_operator(std::string_view line, std::size_t& at) noexcept;

/// @param column  of the operator, for an error
/// @returns an error for a division by zero and for what is no finite number
Expected<double> apply(Operator op, double left, double right, Dialect dialect, int column);

/// Value of a function of one argument by its name in upper case, as "SQRT".
///
/// @param column  of the name, for an error: a name that is not known, an argument outside the
///                function's domain
Expected<double> apply_function(std::string_view name, double argument, Dialect dialect,
                                int column);

/// ATAN[y]/[x] in degrees: -180 to 180; in FANUC's dialect 0 to 360.
double arc_tangent(double y, double x, Dialect dialect) noexcept;

}  // namespace twin::gcode
