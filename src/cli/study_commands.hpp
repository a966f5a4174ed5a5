#pragma once

#include "cli/commands.hpp"

/// The commands of the studies, of the program twin-studies.
namespace twin::cli {

Expected<void> execute(const CompareArguments& arguments, const Environment& environment);
Expected<void> execute(const ReproduceArguments& arguments, const Environment& environment);
Expected<void> execute(const CircleArguments& arguments, const Environment& environment);
Expected<void> execute(const IdentifyArguments& arguments, const Environment& environment);
Expected<void> execute(const CompensateArguments& arguments, const Environment& environment);
Expected<void> execute(const FastestArguments& arguments, const Environment& environment);
Expected<void> execute(const ConvertArguments& arguments, const Environment& environment);
Expected<void> execute(const BatchArguments& arguments, const Environment& environment);
Expected<void> execute(const SweepArguments& arguments, const Environment& environment);
Expected<void> execute(const TuneArguments& arguments, const Environment& environment);
Expected<void> execute(const PlantArguments& arguments, const Environment& environment);
Expected<void> execute(const LinuxcncConfigArguments& arguments, const Environment& environment);
Expected<void> execute(const LinuxcncEvaluateArguments& arguments, const Environment& environment);

}  // namespace twin::cli
