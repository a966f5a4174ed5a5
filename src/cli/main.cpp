#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <exception>
#include <span>

#include "cli/commands.hpp"
#include "cli/usage.hpp"
#include "core/shell_quoted.hpp"
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

int report(const twin::Expected<void>& result) {
  if (result) {
    return 0;
  }
  fmt::print(stderr, "twin: {}\n", twin::to_string(result.error()));
  return twin::exit_status(result.error());
}

}  // namespace

int main(int argc, char** argv) try {
  using namespace twin::cli;
  CLI::App app(
      "twin: digital twin of a servo XY table and of the CNC controller that drives it.\n"
      "Start with: twin run dolphin.nc",
      "twin");
  app.set_version_flag("--version", "twin " TWIN_VERSION);
  app.require_subcommand(1);
  Options options;
  options.command =
      twin::shell_quoted(std::span<const char* const>(argv, static_cast<std::size_t>(argc)));
  const CommandContext context{app, options, stop_requested};
  const std::array commands{add_run(context),    add_plan(context),     add_check(context),
                            add_render(context), add_compare(context),  add_reproduce(context),
                            add_circle(context), add_identify(context), add_convert(context),
                            add_rig(context)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help, --version
    }
    const std::span<const char* const> arguments(argv, static_cast<std::size_t>(argc));
    fmt::print(stderr, "twin: {}\n", usage_error(app, error, arguments.subspan(1)));
    return 2;
  }
  watch_signals();
  const auto chosen =
      std::ranges::find_if(commands, [](const Command& command) { return command.app->parsed(); });
  return report(chosen->execute());
} catch (const std::exception& error) {
  fmt::print(stderr, "twin: {}\n", error.what());
  return 1;
}
