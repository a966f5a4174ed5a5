#pragma once

#include <filesystem>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "shadow/shadow.hpp"
#include "studies/identify/recording_columns.hpp"

namespace twin::studies::shadow {

/// Reads recorded runs for a shadow: traces of this program, or recordings of any machine with the
/// columns that twin identify takes.
///
/// A drive command that is a speed is made volts, and a torque a force, by the machine file's scales.
/// Lines of the NC program and, with shadow.scale, the table's position are taken from traces that
/// have them.
/// @param machine  its period must be that of the file
Expected<std::vector<twin::shadow::Track>> read_tracks(const std::filesystem::path& file,
                                                       const identify::ColumnMap& columns,
                                                       const config::MachineFile& machine);

}  // namespace twin::studies::shadow
