#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <span>
#include <string>
#include <variant>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/terminal.hpp"
#include "core/this_program.hpp"

namespace {

/// Opens standard streams that the caller has closed, so that no file of ours gets the number of one
/// and is printed into. Reading from and writing to them fail as they would have.
void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) {
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

twin::Expected<void> run(std::span<const char* const> words, const std::string& command_line) {
  TWIN_TRY(const twin::cli::Arguments arguments, twin::cli::parse_arguments(words));
  twin::cli::watch_signals();
  const twin::cli::Environment environment{twin::cli::stop_flag(), command_line};
  return std::visit(
      [&](const auto& of_command) { return twin::cli::execute(of_command, environment); },
      arguments);
}

/// Runs a command; what escapes it becomes an error.
twin::Expected<void> run_guarded(std::span<const char* const> words) {
  try {
    return run(words.subspan(words.empty() ? 0 : 1), twin::shell_quoted(words));
  } catch (const std::bad_alloc&) {
    return twin::fail(twin::ErrorCode::kFile, "there is not enough memory");
  } catch (const std::exception& error) {
    return twin::fail(twin::ErrorCode::kFile, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  fill_closed_streams();
  std::signal(SIGPIPE,
              SIG_IGN);  // a reader that has gone is an error of writing, as a full disk is
  auto result = run_guarded({argv, static_cast<std::size_t>(argc)});
  twin::cli::keep_from_being_cut_off();
  if (const auto printed = twin::cli::finish_output(); result && !printed) {
    result = printed;
  }
  if (!result) {
    twin::cli::print_error(result.error());
    return twin::exit_status(result.error());
  }
  return 0;
}
