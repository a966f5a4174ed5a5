#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "results/trace/decimator.hpp"

namespace twin::pictures {

/// Writes the data of a figure as NAME.csv into a folder.
Expected<void> write_table(const std::filesystem::path& folder, const std::string& name,
                           std::span<const std::string_view> columns, const results::Table& table);

}  // namespace twin::pictures
