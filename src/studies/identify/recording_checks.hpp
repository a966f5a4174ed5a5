#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "studies/identify/recording.hpp"

namespace twin::studies::identify {

/// An error about a recorded file. @param line  of the file, from 1; 0: none
tl::unexpected<Error> about(const std::filesystem::path& file, std::string message, int line = 0);

/// Checks whether a recording that was read can be what it claims to be; sets has_moved and notes.
/// @param limits  of the machine, for what is plausible
Expected<void> check_recording(Recording& recording, const ColumnMap& columns,
                               const Limits& limits);

}  // namespace twin::studies::identify
