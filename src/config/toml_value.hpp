#pragma once

#include <toml++/toml.h>

#include <string_view>

#include "config/binding.hpp"
#include "core/error.hpp"

namespace twin::config {

/// Parses TOML; a syntax error is kFile with file, line and column.
Expected<toml::table> parse_toml(std::string_view text, const std::string& file);

/// A TOML value as a setting's value; dates and tables are no setting's value.
Expected<Value> value_of(const toml::node& node);

}  // namespace twin::config
