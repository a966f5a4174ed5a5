#pragma once

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"

namespace twin::cli {

/// `twin run` with its correction, what it learns and its prediction, of which each may be absent.
Expected<void> run_with_studies(const RunArguments& arguments, const Environment& environment);

}  // namespace twin::cli
