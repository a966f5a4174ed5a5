#pragma once

#include <atomic>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "feedrate/bound/time_bound.hpp"
#include "gcode/program_text.hpp"

namespace twin::runtime {

/// Plans a program and bounds the time of its path from below, see feedrate::TimeBound.
///
/// @param feedrate  replaces the program's F words [mm/s]
/// @param stop      ends it with kInterrupted; may be null
/// @param profile   if given, gets the bound's feedrate along the path
/// @returns [s]
Expected<double> time_bound(const gcode::ProgramText& program, const config::MachineFile& machine,
                            const std::optional<double>& feedrate,
                            const std::atomic<bool>* stop = nullptr,
                            feedrate::TimeBound::Profile profile = {});

}  // namespace twin::runtime
