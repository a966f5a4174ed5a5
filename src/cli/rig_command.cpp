#include <algorithm>
#include <vector>

#include "cli/commands.hpp"

namespace twin::cli {

Command add_rig(const CommandContext& context) {
  CLI::App* const app = context.app.add_subcommand(
      "rig", "Bring up and exercise the rig: probe, monitor, check, jog, home, emulate");
  app->require_subcommand(1);
  const CommandContext inner{*app, context.options, context.stop};
  const std::vector<Command> commands{add_rig_probe(inner), add_rig_monitor(inner),
                                      add_rig_check(inner), add_rig_jog(inner),
                                      add_rig_home(inner),  add_rig_emulate(inner)};
  return {app, [commands] {
            return std::ranges::find_if(
                       commands, [](const Command& command) { return command.app->parsed(); })
                ->execute();
          }};
}

}  // namespace twin::cli
