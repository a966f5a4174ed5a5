#pragma once

#include <filesystem>
#include <string>

namespace twin::pictures {

/// What summary.json says of the trace beside it, as far as figures show it.
struct RunOrigin {
  bool is_simulated = false;  ///< a machine moved, but no metal; false when nothing is known
  double period = 0.0;        ///< [s]; 0 when nothing is known
};

/// Reads it from a folder of results; a file that is missing or is none says nothing.
RunOrigin read_run_origin(const std::filesystem::path& directory);

/// "dolphin.nc, simulated": a title that says so where it is.
std::string title_of(const std::string& title, const RunOrigin& origin);

}  // namespace twin::pictures
