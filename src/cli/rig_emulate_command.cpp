#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/rigs.hpp"
#include "hal/rig/emulator/serve.hpp"
#include "runtime/realtime_thread.hpp"

namespace twin::cli {
namespace rig = hal::rig;

Expected<void> execute(const RigEmulateArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  rig::emulator::ServeSettings settings;
  settings.name = shared_name(arguments.rig);
  settings.duration = arguments.duration;
  for (const std::string& text : arguments.rig.faults) {
    TWIN_TRY(const auto fault, rig::emulator::parse_fault(text));
    settings.faults.push_back(fault);
  }
  const auto tell = [](std::string_view line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  settings.started = [&] {
    tell(fmt::format("emulated rig (simulated), process {}, registers in {}; Ctrl-C ends it",
                     getpid(), shared_name(arguments.rig)));
  };
  // Above a controller on the same machine, or its command would outrun the plant.
  RealtimeSettings pace = machine.realtime;
  pace.priority = pace.priority > 0 ? std::min(pace.priority + 5, 98) : 0;
  const runtime::RealtimeThread realtime(pace);
  for (const std::string& note : realtime.notes()) {
    tell("note: " + note);
  }
  TWIN_TRY(const auto result,
           rig::emulator::serve(machine.table, machine.rig, settings, environment.stop, tell));
  tell(fmt::format(
      "{:.3f} s simulated in {} steps, {} of them late, {:.3f} s of the wall clock left "
      "out; {} edges lost by the counters' filters",
      result.plant_time, result.steps, result.late_steps, result.left_out, result.lost_edges));
  return {};
}

}  // namespace twin::cli
