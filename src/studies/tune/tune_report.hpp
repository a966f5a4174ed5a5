#pragma once

#include <filesystem>
#include <string>

#include "studies/tune/tune.hpp"

namespace twin::studies::tune {

/// For the terminal: the settings, margins, and every program before and after.
std::string to_table(const Task& task, const Tuning& tuning);

/// tune.json: settings, margins and figures before and after, the effort.
std::string to_json(const Task& task, const Tuning& tuning);

/// Writes best.toml, the machine file with the settings found; tune.json; and of all trials
/// results.csv, results.h5 and index.html as a sweep does, with the front of time and contour error.
Expected<void> write_tuning(const Task& task, const Tuning& tuning,
                            const std::filesystem::path& folder);

}  // namespace twin::studies::tune
