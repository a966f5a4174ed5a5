#pragma once

#include <filesystem>
#include <string_view>

#include "core/error.hpp"
#include "results/trace/trace_files.hpp"
#include "runtime/run.hpp"

/// The files that a run leaves in its folder, but for trace and pictures.
namespace twin::session {

/// Makes the folder of a file that will be written at the end of long work, and refuses a name that
/// cannot become a file.
Expected<void> prepare_output_file(const std::filesystem::path& file);

/// The folder of a program's results: `chosen`, or renders/NAME where that is empty.
std::filesystem::path result_folder(const std::filesystem::path& chosen,
                                    const std::filesystem::path& name);

/// What the shadow of a run has seen, where it had one.
inline constexpr std::string_view kShadowName = "shadow.json";

/// Writes summary.json, or summary.partial.json for a run that failed.
Expected<void> write_summary(const std::filesystem::path& folder, const runtime::RunResult& result);

/// Whether a run has come to the end of its program.
enum class Results { kWhole, kPartial };
/// Removes the files of an earlier run in the folder that this run does not make again, so that
/// they do not pass for its own.
void remove_stale_results(const std::filesystem::path& folder, Results how,
                          results::TraceFiles trace);

}  // namespace twin::session
