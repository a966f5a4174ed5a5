#include "cli/confirmation.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <iostream>
#include <string>

namespace twin::cli {

Expected<void> confirm_motion(const hal::MachineInfo& machine, bool is_known,
                              const std::string& what) {
  if (machine.simulated || is_known) {
    return {};
  }
  if (isatty(STDIN_FILENO) != 1) {
    return fail(ErrorCode::kUsage, "machine '" + machine.name +
                                       "' is real and would move; say so with --i-know-it-moves, "
                                       "or start it at a terminal and confirm there");
  }
  fmt::print("This is a REAL machine. {} will move it. Type move to go on: ", what);
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "move") {
    return fail(ErrorCode::kInterrupted, "not confirmed: nothing has moved");
  }
  return {};
}

}  // namespace twin::cli
