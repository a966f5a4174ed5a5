#pragma once

#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"
#include "results/trace/sample.hpp"
#include "runtime/motion.hpp"

namespace twin::runtime {

/// What was thrown, as an error of the run; called in a catch block. @param where who threw it
Error thrown(const char* where);

/// Why a motion ended early, for the user; nothing if it did not.
///
/// @param last  what was recorded last
/// @param hal     null: there was no machine
/// @param advice  for a trip, where more is known of it than its kind; may be empty
std::optional<Error> describe_end(const MotionResult& motion, const results::Sample& last,
                                  const hal::Machine* hal, const std::string& advice);

/// What a user should do where a trip comes from a position loop that oscillates by the model of the
/// machine file; empty where it does not.
std::string advice_on_loop(const motion::Trip& trip, const config::MachineFile& machine);

}  // namespace twin::runtime
