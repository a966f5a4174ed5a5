#pragma once

#include <string>
#include <utility>

#include "core/error.hpp"

namespace twin::gcode {

/// A fault of the program at a column of the line being read; Reader adds the file and the line.
///
/// @param column   column in the line, in bytes from 1, or 0
/// @param message  what was found and what was expected
inline tl::unexpected<Error> fail_at(int column, std::string message) {
  return tl::unexpected<Error>(Error{ErrorCode::kProgram, std::move(message), {}, 0, column});
}

}  // namespace twin::gcode
