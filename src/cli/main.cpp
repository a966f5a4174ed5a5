#include <fmt/core.h>

#include <atomic>
#include <csignal>
#include <exception>
#include <span>
#include <string>
#include <variant>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/terminal.hpp"
#include "core/this_program.hpp"
#include "operator/terminal.hpp"

namespace {

std::atomic<bool> stop_requested{false};

/// The first signal brakes on the path and keeps the results; a second one ends the process as
/// usual, with the terminal as it was.
extern "C" void request_stop(int signal) {
  if (stop_requested.exchange(true)) {
    twin::operator_station::RawTerminal::restore();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

void watch_signals() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    sigaction(signal, &action, nullptr);
  }
}

twin::Expected<void> run(std::span<const char* const> words, const std::string& command_line) {
  TWIN_TRY(const twin::cli::Arguments arguments, twin::cli::parse_arguments(words));
  watch_signals();
  const twin::cli::Environment environment{stop_requested, command_line};
  return std::visit(
      [&](const auto& of_command) { return twin::cli::execute(of_command, environment); },
      arguments);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::span<const char* const> all(argv, static_cast<std::size_t>(argc));
  const auto result = run(all.subspan(all.empty() ? 0 : 1), twin::shell_quoted(all));
  if (!result) {
    twin::cli::print_error(result.error());
    return twin::exit_status(result.error());
  }
  return 0;
} catch (const std::exception& error) {
  twin::cli::print_error(error.what());
  return 1;
}
