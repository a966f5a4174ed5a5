#pragma once

#include <span>
#include <string>

namespace twin {

/// Words as one line that a POSIX shell would take apart into the same words:
///   twin run 'my program.nc'
std::string shell_quoted(std::span<const char* const> words);

}  // namespace twin
