#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace twin::hal::rig::guard {

/// The command line of twin-guard, which the controller writes and the guard reads.
struct GuardArguments {
  int page = -1;              ///< descriptor of the shared memory
  int lifeline = -1;          ///< descriptor of the read end of a pipe of the controller
  std::string outputs;        ///< where the outputs are (guarded_outputs.hpp)
  unsigned safe_digital = 0;  ///< digital outputs with the servos off, 16 bits
  int timeout_ms = 0;         ///< longest silence of the controller [ms]
};

/// The arguments as a program gets them, without its name: each flag before its value.
std::vector<std::string> to_text(const GuardArguments& arguments);

/// The arguments back from their texts. Each flag must be there once and nothing else may be.
/// @returns a kUsage error that names the flag, what it was given and what it takes
Expected<GuardArguments> parse_guard_arguments(std::span<const char* const> texts);

}  // namespace twin::hal::rig::guard
