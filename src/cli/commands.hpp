#pragma once

#include <atomic>
#include <string>

#include "cli/arguments.hpp"
#include "core/error.hpp"

/// The commands of one run, each of which returns what keeps the exit status from being 0.
namespace twin::cli {

/// What all commands are executed with.
struct Environment {
  const std::atomic<bool>& stop;  ///< set when the user wants to end
  std::string command_line;       ///< quoted as a shell takes it
};

Expected<void> execute(const TextArguments& arguments, const Environment& environment);
Expected<void> execute(const RunArguments& arguments, const Environment& environment);
Expected<void> execute(const PlanArguments& arguments, const Environment& environment);
Expected<void> execute(const CheckArguments& arguments, const Environment& environment);
Expected<void> execute(const RenderArguments& arguments, const Environment& environment);
Expected<void> execute(const ReportArguments& arguments, const Environment& environment);
Expected<void> execute(const SettingsArguments& arguments, const Environment& environment);
Expected<void> execute(const RigProbeArguments& arguments, const Environment& environment);
Expected<void> execute(const RigMonitorArguments& arguments, const Environment& environment);
Expected<void> execute(const RigCheckArguments& arguments, const Environment& environment);
Expected<void> execute(const RigJogArguments& arguments, const Environment& environment);
Expected<void> execute(const RigHomeArguments& arguments, const Environment& environment);
Expected<void> execute(const RigEmulateArguments& arguments, const Environment& environment);

}  // namespace twin::cli
