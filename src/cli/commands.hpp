#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <functional>

#include "cli/options.hpp"
#include "core/error.hpp"

/// The subcommands, one file each.
namespace twin::cli {

/// A subcommand: its options, and what it does once they are parsed.
struct Command {
  CLI::App* app = nullptr;
  std::function<Expected<void>()> execute;  ///< returns what keeps the exit status from being 0
};

/// What all subcommands are made with. `options` and `stop` outlive them.
struct CommandContext {
  CLI::App& app;
  Options& options;
  const std::atomic<bool>& stop;  ///< set when the user wants to end
};

Command add_run(const CommandContext& context);
Command add_plan(const CommandContext& context);
Command add_check(const CommandContext& context);
Command add_render(const CommandContext& context);
Command add_compare(const CommandContext& context);
Command add_reproduce(const CommandContext& context);
Command add_circle(const CommandContext& context);
Command add_identify(const CommandContext& context);
Command add_convert(const CommandContext& context);
Command add_rig(const CommandContext& context);

// Below `twin rig`.
Command add_rig_probe(const CommandContext& context);
Command add_rig_monitor(const CommandContext& context);
Command add_rig_check(const CommandContext& context);
Command add_rig_jog(const CommandContext& context);
Command add_rig_home(const CommandContext& context);
Command add_rig_emulate(const CommandContext& context);

}  // namespace twin::cli
