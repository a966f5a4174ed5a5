#pragma once

#include "cli/arguments.hpp"

namespace CLI {
class App;
}

/// The options of each command: their names, what they take and what their help says.
namespace twin::cli {

void add_options(CLI::App& command, RunArguments& arguments);
void add_options(CLI::App& command, PlanArguments& arguments);
void add_options(CLI::App& command, CheckArguments& arguments);
void add_options(CLI::App& command, RenderArguments& arguments);
void add_options(CLI::App& command, ReportArguments& arguments);
void add_options(CLI::App& command, SettingsArguments& arguments);
void add_options(CLI::App& command, CompareArguments& arguments);
void add_options(CLI::App& command, ReproduceArguments& arguments);
void add_options(CLI::App& command, CircleArguments& arguments);
void add_options(CLI::App& command, IdentifyArguments& arguments);
void add_options(CLI::App& command, CompensateArguments& compensate);
void add_options(CLI::App& command, ShadowCommandArguments& shadow);
void add_options(CLI::App& command, FastestArguments& fastest);
void add_options(CLI::App& command, ConvertArguments& arguments);
void add_options(CLI::App& command, BatchArguments& arguments);
void add_options(CLI::App& command, SweepArguments& arguments);
void add_options(CLI::App& command, RigProbeArguments& arguments);
void add_options(CLI::App& command, RigMonitorArguments& arguments);
void add_options(CLI::App& command, RigCheckArguments& arguments);
void add_options(CLI::App& command, RigJogArguments& arguments);
void add_options(CLI::App& command, RigHomeArguments& arguments);
void add_options(CLI::App& command, RigEmulateArguments& arguments);
void add_options(CLI::App& command, PlantArguments& arguments);
void add_options(CLI::App& command, LinuxcncConfigArguments& arguments);
void add_options(CLI::App& command, LinuxcncEvaluateArguments& arguments);

}  // namespace twin::cli
