#pragma once

#include <string>

#include "core/json.hpp"
#include "studies/identify/validation.hpp"

namespace twin::studies::identify {

/// A prediction beside its baselines, for the terminal.
std::string validation_table(const Validation& validation);
/// The same as JSON.
Json validation_json(const Validation& validation);

/// What the motor's force says, with friction that is the same either way and with one that differs.
std::string inverse_table(const InverseModel& alike, const InverseModel& two_way);
/// One of the two as JSON.
Json inverse_json(const InverseModel& model);

/// Errors in um as JSON.
Json error_json(const results::ErrorStats& error);

}  // namespace twin::studies::identify
