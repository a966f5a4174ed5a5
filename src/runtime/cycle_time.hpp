#pragma once

#include <atomic>
#include <filesystem>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::runtime {

/// Plans a whole program and moves nothing: the figures of its plan, whose time is the cycle time
/// that a run takes, less than a period aside.
///
/// @param stop  ends it with kInterrupted; may be null
Expected<PlanFigures> estimate_plan(const std::filesystem::path& program,
                                    const gcode::ReaderOptions& options,
                                    const config::MachineFile& machine,
                                    const std::atomic<bool>* stop);

}  // namespace twin::runtime
