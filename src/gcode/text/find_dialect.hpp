#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "gcode/program_text.hpp"
#include "gcode/reader_options.hpp"

namespace twin::gcode {

/// What shows in whose language a program is written.
struct DialectSign {
  Dialect dialect = Dialect::kLinuxCnc;
  std::string sign;       ///< as in "GOTO"
  std::int64_t line = 0;  ///< where it is
};

/// Looks for a sign in the first lines of a program. O-words with a keyword, names of parameters
/// and messages are LinuxCNC's; a program number, GOTO, WHILE with DO, G65, G05.1 and G54.1 are
/// FANUC's; lines that begin with $ are grbl's. Of several signs LinuxCNC's count first.
std::optional<DialectSign> find_dialect(const ProgramText& program);

}  // namespace twin::gcode
