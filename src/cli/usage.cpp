#include "cli/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "config/nearest_name.hpp"

namespace twin::cli {
namespace {

bool is_option(std::string_view word) { return word.size() > 1 && word[0] == '-'; }

/// The first option that a command does not have; empty if there is none.
std::string unknown_option(const CommandNames& command, std::span<const char* const> words) {
  for (const std::string_view word : words) {
    const std::string_view name = word.substr(0, word.find('='));
    if (word == "--") {
      break;
    }
    if (is_option(word) && std::ranges::find(command.options, name) == command.options.end()) {
      return fmt::format("unknown option {}{}", name, config::did_you_mean(name, command.options));
    }
  }
  return {};
}

/// Explains the command line of a command that has others below it, of which one must follow.
std::string explain_choice(const CommandNames& command, std::span<const char* const> words) {
  std::vector<std::string> names;
  std::ranges::transform(command.commands, std::back_inserter(names), &CommandNames::name);
  if (words.empty()) {
    return command.name.empty()
               ? std::string()
               : fmt::format("{} wants a command: {}", command.name, fmt::join(names, ", "));
  }
  const std::string_view first = words[0];
  if (is_option(first)) {
    return unknown_option(command, words.first(1));
  }
  const auto chosen = std::ranges::find(command.commands, first, &CommandNames::name);
  if (chosen == command.commands.end()) {
    return fmt::format("unknown command {}{}", first, config::did_you_mean(first, names));
  }
  return explain(*chosen, words.subspan(1));
}

}  // namespace

std::string explain(const CommandNames& names, std::span<const char* const> words) {
  return names.commands.empty() ? unknown_option(names, words) : explain_choice(names, words);
}

}  // namespace twin::cli
