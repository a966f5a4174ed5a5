#include <variant>

#include "cli/program.hpp"
#include "cli/run_command.hpp"

// The program twin: the commands of one run.
namespace {

using twin::cli::Arguments;
using twin::cli::Environment;

template <class Command>
constexpr bool kIsHere = requires(const Command& command, const Environment& environment) {
  twin::cli::execute(command, environment);
};

bool has(const Arguments& arguments) {
  if (const auto* const run = std::get_if<twin::cli::RunArguments>(&arguments)) {
    return !needs_studies(*run);
  }
  return std::visit([]<class Command>(const Command&) { return kIsHere<Command>; }, arguments);
}

twin::Expected<void> execute(const Arguments& arguments, const Environment& environment) {
  return std::visit(
      [&]<class Command>(const Command& command) -> twin::Expected<void> {
        if constexpr (kIsHere<Command>) {
          return twin::cli::execute(command, environment);
        }
        return {};
      },
      arguments);
}

}  // namespace

int main(int argc, char** argv) { return twin::cli::run_command_line(argc, argv, {has, execute}); }
