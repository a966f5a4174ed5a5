#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "cli/commands.hpp"
#include "cli/rig_ports.hpp"
#include "hal/rig/emulator/serve.hpp"
#include "runtime/realtime_thread.hpp"

namespace twin::cli {
namespace {

namespace rig = hal::rig;

Expected<void> emulate(const Options& options, const std::atomic<bool>& stop) {
  const auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  rig::emulator::ServeSettings settings;
  settings.name = shared_name(options);
  settings.duration = options.for_s;
  for (const std::string& text : options.faults) {
    const auto fault = rig::emulator::parse_fault(text);
    if (!fault) {
      return tl::unexpected(fault.error());
    }
    settings.faults.push_back(*fault);
  }
  const auto tell = [](std::string_view line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  tell(fmt::format("emulated rig (simulated), process {}, registers in {}; Ctrl-C ends it",
                   getpid(), shared_name(options)));
  // Above a controller on the same machine, or its command would outrun the plant.
  RealtimeSettings pace = machine->realtime;
  pace.priority = pace.priority > 0 ? std::min(pace.priority + 5, 98) : 0;
  const runtime::RealtimeThread realtime(pace);
  for (const std::string& note : realtime.notes()) {
    tell("note: " + note);
  }
  const auto result = rig::emulator::serve(machine->table, machine->rig, settings, stop, tell);
  if (!result) {
    return tl::unexpected(result.error());
  }
  tell(fmt::format(
      "{:.3f} s simulated in {} steps, {} of them late, {:.3f} s of the wall clock left "
      "out; {} edges lost by the counters' filters",
      result->plant_time, result->steps, result->late_steps, result->left_out, result->lost_edges));
  return {};
}

}  // namespace

Command add_rig_emulate(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "emulate",
      "Run cards, drives and table as a process of its own on the wall clock, for --hal rig");
  add_machine_options(*app, options);
  app->add_option("--rig-name", options.rig_name, "Shared memory [/twin-rig-UID]")
      ->type_name("/NAME");
  app->add_option("--for", options.for_s, "End after so long")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS");
  add_fault_option(*app, options);
  return {app, [&options, &stop = context.stop] { return emulate(options, stop); }};
}

}  // namespace twin::cli
