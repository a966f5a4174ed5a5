#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "studies/identify/identify.hpp"

namespace twin::studies::identify {

/// The result as a table for the terminal.
std::string to_table(const Identification& result);

/// The result as JSON: machine, axes with their parameters, predictions, notes.
std::string to_json(const Identification& result, const std::filesystem::path& machine_file);

/// The identified machine as the text of a machine file: every fitted value with where it comes
/// from in its comment.
std::string to_machine_file(const Identification& result);

/// What a fit says of a parameter: "identified", "measured", "uncertain", "not
/// shown" or "fixed".
std::string_view verdict_name(Verdict verdict);

}  // namespace twin::studies::identify
