#include "cli/usage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "config/nearest_name.hpp"

namespace twin::cli {
namespace {

bool is_option(std::string_view argument) { return argument.size() > 1 && argument[0] == '-'; }

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
    for (const std::string& name : option->get_snames()) {
      names.push_back("-" + name);
    }
  }
  return names;
}

/// The first option that a command does not have; empty if there is none.
std::string unknown_option(const CLI::App& command, std::span<const char* const> arguments) {
  const std::vector<std::string> names = option_names(command);
  for (const std::string_view argument : arguments) {
    const std::string_view name = argument.substr(0, argument.find('='));
    if (argument == "--") {
      break;
    }
    if (is_option(argument) && std::ranges::find(names, name) == names.end()) {
      return fmt::format("unknown option {}{}", name, config::did_you_mean(name, names));
    }
  }
  return {};
}

/// What is wrong with the arguments of a command; empty where that cannot be told. Looks into the
/// commands below it: `twin rig probe`.
std::string explain(const CLI::App& app, std::span<const char* const> arguments) {
  const std::vector<std::string> commands = command_names(app);
  if (commands.empty()) {
    return unknown_option(app, arguments);
  }
  if (arguments.empty()) {
    return app.get_parent() == nullptr
               ? std::string()
               : fmt::format("{} wants a command: {}", app.get_name(), fmt::join(commands, ", "));
  }
  const std::string_view first = arguments[0];
  if (is_option(first)) {
    return unknown_option(app, arguments.first(1));
  }
  if (std::ranges::find(commands, first) == commands.end()) {
    return fmt::format("unknown command {}{}", first, config::did_you_mean(first, commands));
  }
  return explain(*app.get_subcommand(std::string(first)), arguments.subspan(1));
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        std::span<const char* const> arguments) {
  std::string text = explain(app, arguments);
  if (text.empty()) {
    text = error.what();
  }
  std::ranges::replace(text, '\n', ' ');
  return text + " (twin --help lists what there is)";
}

}  // namespace twin::cli
