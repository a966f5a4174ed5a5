#pragma once

#include <atomic>
#include <string>

#include "cli/arguments.hpp"
#include "core/error.hpp"

/// The commands, each of which returns what keeps the exit status from being 0.
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
Expected<void> execute(const CompareArguments& arguments, const Environment& environment);
Expected<void> execute(const ReproduceArguments& arguments, const Environment& environment);
Expected<void> execute(const CircleArguments& arguments, const Environment& environment);
Expected<void> execute(const IdentifyArguments& arguments, const Environment& environment);
Expected<void> execute(const ConvertArguments& arguments, const Environment& environment);
Expected<void> execute(const BatchArguments& arguments, const Environment& environment);
Expected<void> execute(const SweepArguments& arguments, const Environment& environment);
Expected<void> execute(const TuneArguments& arguments, const Environment& environment);
Expected<void> execute(const RigProbeArguments& arguments, const Environment& environment);
Expected<void> execute(const RigMonitorArguments& arguments, const Environment& environment);
Expected<void> execute(const RigCheckArguments& arguments, const Environment& environment);
Expected<void> execute(const RigJogArguments& arguments, const Environment& environment);
Expected<void> execute(const RigHomeArguments& arguments, const Environment& environment);
Expected<void> execute(const RigEmulateArguments& arguments, const Environment& environment);

/// What is wrong with the name of a dialect of `twin convert --to`; empty for a sound one.
std::string dialect_error(const std::string& name);

}  // namespace twin::cli
