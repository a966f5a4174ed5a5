#include <variant>

#include "cli/corrected_run.hpp"
#include "cli/program.hpp"
#include "cli/study_commands.hpp"

// The program twin-studies: all commands, those of many runs among them.
namespace {

using twin::cli::Arguments;
using twin::cli::Environment;

twin::Expected<void> execute(const Arguments& arguments, const Environment& environment) {
  if (const auto* const run = std::get_if<twin::cli::RunArguments>(&arguments)) {
    return twin::cli::run_with_studies(*run, environment);
  }
  return std::visit([&](const auto& command) { return twin::cli::execute(command, environment); },
                    arguments);
}

}  // namespace

int main(int argc, char** argv) {
  return twin::cli::run_command_line(argc, argv, {[](const Arguments&) { return true; }, execute});
}
