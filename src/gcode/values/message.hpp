#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace twin::gcode {

class Parameters;

/// What a comment says to the operator: the text of (MSG, ...), and of (DEBUG, ...), (PRINT, ...)
/// and (LOG, ...) with parameters replaced by their values, as in "(DEBUG, depth %.2f#3)". Nothing
/// for other comments. A name without a value shows as ######. Source: LinuxCNC, "G-code overview",
/// messages and comment parameters.
///
/// @param comment  without its parentheses
std::optional<std::string> message_of(std::string_view comment, const Parameters& parameters);

}  // namespace twin::gcode
