#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "session/pictures.hpp"

/// The page that shows a run, or several side by side.
namespace twin::session {

/// Name of the page in the folder of a run.
inline constexpr std::string_view kReportName = "report.html";

/// Finds the program of a trace: none if it is gone or has become another one.
using FindProgram = std::function<std::optional<gcode::ProgramText>(const TraceOrigin& origin)>;

/// Writes a page from the traces and summaries in the folders of runs. A run that ended early is
/// shown as what it is.
///
/// @param file  the page
/// @returns an error that names the file where a folder holds no run, or where trace and summary
///          are of different runs
Expected<void> write_report(std::span<const std::filesystem::path> folders,
                            const FindProgram& find_program, const std::filesystem::path& file);

}  // namespace twin::session
