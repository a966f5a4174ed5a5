#pragma once

#include <string>
#include <vector>

#include "twin/export.hpp"
#include "twin/program.hpp"

namespace twin {

/// Writes the page of a run, or of several side by side, as `twin report` does: one HTML file that
/// needs no network.
///
/// @param folders   of runs, with trace and summary
/// @param file      the page; its folder is made if it is missing
/// @param programs  those that were run, for their text and path; one that twin brings, or that is
///                  where the command was called, is found without
/// @throws Failure if a folder holds no run, or trace and summary of different ones
TWIN_EXPORT void write_report(const std::vector<std::string>& folders, const std::string& file,
                              const std::vector<Program>& programs = {});

}  // namespace twin
