#pragma once

#include <cstddef>
#include <string_view>

#include "core/error.hpp"

namespace twin::gcode {

class Parameters;

/// Reads a value that a program computes, at a place of a line, and steps over it.
///
///   value      = [ sign ] number | [ sign ] ( parameter | expression | function )
///   parameter  = # value | # < name >
///   expression = [ operand { operator operand } ]
///   function   = name expression | ATAN expression / expression
///              | EXISTS [ # < name > ] | EXISTS [ # value ]
/// Operators from the strongest: **; * / MOD; + -; EQ NE GT GE LT LE; AND OR XOR. Of the same
/// strength the left one comes first. Angles are in degrees, true is 1, anything but 0 counts as
/// true, and EQ and NE take values less than 1e-6 apart as equal. Blanks may stand anywhere.
/// Source: LinuxCNC, "G-code overview", expressions.
///
/// In FANUC's dialect FIX and FUP round towards and away from zero, ATAN gives 0 to 360 degrees,
/// AND OR XOR work on the bits of whole numbers, and POW[x, y], ATAN[y, x], RND and SQR are known.
/// Source: FANUC, Custom Macro B, arithmetic and logic operation.
///
/// @param at  place of the value's first character; afterwards the place behind it
/// @returns the value, finite; or an error with its column. FANUC's null is 0.
Expected<double> read_value(std::string_view line, std::size_t& at, const Parameters& parameters);
/// The same, but null stays null.
Expected<double> read_value_or_null(std::string_view line, std::size_t& at,
                                    const Parameters& parameters);

/// True if a character can begin a value that is not a plain number.
constexpr bool begins_value(char c) noexcept { return c == '#' || c == '['; }

/// Reads `# number = value` or `# < name > = value`, from the #, and keeps it for
/// Parameters::commit(). Operators may stand in the value without brackets, as FANUC writes them.
Expected<void> read_assignment(std::string_view line, std::size_t& at, Parameters& parameters);

}  // namespace twin::gcode
