#pragma once

#include <filesystem>
#include <string>

#include "cli/options.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "runtime/run.hpp"

namespace twin::cli {

/// Makes the folder of a file that will be written at the end of long work, and refuses a name that
/// cannot become one.
Expected<void> prepare_output_file(const std::filesystem::path& file);

/// Removes the files of an earlier run in the folder that this one does not make again.
void remove_stale_results(const std::filesystem::path& folder);

/// Writes summary.json, or summary.partial.json for a run that failed.
Expected<void> write_summary(const std::filesystem::path& folder, const runtime::RunResult& result);

/// Draws the figures of the trace in a folder.
Expected<void> write_plots(const std::filesystem::path& folder,
                           const std::filesystem::path& program, const std::string& title,
                           bool plan_only, bool quiet);

/// Renders the video of the trace in a folder.
Expected<void> write_video(const std::filesystem::path& folder, const std::filesystem::path& model,
                           const std::string& title, const Options& options);

}  // namespace twin::cli
