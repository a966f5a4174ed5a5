#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace twin::config {

/// A whole small file as text. Missing, unreadable, a directory, larger than 16 MB or with NUL
/// bytes: a kFile error.
Expected<std::string> read_text(const std::filesystem::path& file);

}  // namespace twin::config
