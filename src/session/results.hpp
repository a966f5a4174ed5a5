#pragma once

#include <filesystem>

#include "core/error.hpp"
#include "runtime/run.hpp"

/// The files that a run leaves in its folder, but for trace and pictures.
namespace twin::session {

/// Makes the folder of a file that will be written at the end of long work, and refuses a name that
/// cannot become a file.
Expected<void> prepare_output_file(const std::filesystem::path& file);

/// The folder of a program's results: `chosen`, or renders/NAME where that is empty.
std::filesystem::path result_folder(const std::filesystem::path& chosen,
                                    const std::filesystem::path& name);

/// Writes summary.json, or summary.partial.json for a run that failed.
Expected<void> write_summary(const std::filesystem::path& folder, const runtime::RunResult& result);

/// Removes the files of an earlier run in the folder that this run does not make again.
void remove_stale_results(const std::filesystem::path& folder);

}  // namespace twin::session
