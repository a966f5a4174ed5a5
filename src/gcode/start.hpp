#pragma once

#include "core/vec.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader_options.hpp"

namespace twin::gcode {

/// Where the machine stands before a program's first block [mm].
///
/// That is the place of the options. If they lift the start, their place has height 0, and the first
/// move is a rapid across, it is above that place instead, at the height to which the rapids before
/// the first feed move lead: a post believes the tool to be clear of the workpiece when it begins,
/// and at height 0 its first rapid would be a cut.
Vec3 start_of(const ProgramText& program, const ReaderOptions& options);

}  // namespace twin::gcode
