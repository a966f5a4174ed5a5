#pragma once

#include <optional>

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
/// @param hal   null: there was no machine
std::optional<Error> describe_end(const MotionResult& motion, const results::Sample& last,
                                  const hal::Machine* hal);

}  // namespace twin::runtime
