#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "config/binding.hpp"
#include "core/error.hpp"

/// The text of a TOML file, its tables and their values.
namespace twin::config {

/// A whole small file as text. Missing, unreadable, a directory, larger than 16 MB or with NUL
/// bytes: a kFile error.
Expected<std::string> read_text(const std::filesystem::path& file);

/// Parses TOML; a syntax error is kFile with file, line and column.
Expected<toml::table> parse_toml(std::string_view text, const std::string& file);

/// A TOML value as a setting's value; dates and tables are no setting's value.
Expected<Value> value_of(const toml::node& node);

}  // namespace twin::config
