#pragma once

#include <atomic>
#include <optional>

#include "cli/arguments.hpp"
#include "core/error.hpp"
#include "session/session.hpp"

namespace twin::cli {

/// With --tolerance-um: says with what probability the run of a request keeps a tolerance, on the
/// terminal and among the notes of its summary. Without it does nothing.
///
/// @param tolerance  [mm]
Expected<void> predict_errors(const std::optional<double>& tolerance, Verbosity verbosity,
                              const std::atomic<bool>& stop, session::Request& request);

}  // namespace twin::cli
