#include "cli/program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>
#include <filesystem>
#include <span>
#include <string>

#include "cli/interruption.hpp"
#include "cli/terminal.hpp"
#include "core/atomic_file.hpp"
#include "core/this_program.hpp"

namespace twin::cli {
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

/// Puts the program that has the studies in the place of this one. @returns why it could not
Expected<void> hand_over(char** argv) {
  const std::filesystem::path program = program_beside("twin-studies");
  execv(program.c_str(), argv);
  return file_error(program, "start the program of this command", errno);
}

/// @param argv  as main() has it, with a null pointer at its end
Expected<void> run(std::span<char*> argv, const Commands& commands) {
  const std::span<const char* const> words(argv.data(), argv.size());
  TWIN_TRY(const Arguments arguments, parse_arguments(words.subspan(words.empty() ? 0 : 1)));
  if (!commands.has(arguments)) {
    return hand_over(argv.data());
  }
  watch_signals();
  return commands.execute(arguments, {stop_flag(), shell_quoted(words)});
}

/// Runs a command; what escapes it becomes an error.
Expected<void> run_guarded(std::span<char*> argv, const Commands& commands) {
  try {
    return run(argv, commands);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kFile, "there is not enough memory");
  } catch (const std::exception& error) {
    return fail(ErrorCode::kFile, error.what());
  }
}

}  // namespace

int run_command_line(int argc, char** argv, const Commands& commands) {
  fill_closed_streams();
  // A reader that has gone is an error of writing, as a full disk is.
  std::signal(SIGPIPE, SIG_IGN);
  auto result = run_guarded({argv, static_cast<std::size_t>(argc)}, commands);
  keep_from_being_cut_off();
  if (const auto printed = finish_output(); result && !printed) {
    result = printed;
  }
  if (!result) {
    print_error(result.error());
    return exit_status(result.error());
  }
  return 0;
}

}  // namespace twin::cli
