#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "cli/commands.hpp"
#include "cli/rig_look.hpp"
#include "hal/rig/rig_view.hpp"

namespace twin::cli {
namespace {

namespace rig = hal::rig;
using Clock = std::chrono::steady_clock;

constexpr auto kInterval = std::chrono::milliseconds(100);

/// "  x     1234 cnt   8.3391 mm   0.0123 V  ready P-OT"
std::string axis_text(std::size_t axis, const rig::RigView& view, double mm_per_count) {
  const rig::DriveInputs& drive = view.drives[axis];
  std::string flags;
  for (const auto& [given, name] :
       {std::pair(drive.ready, "ready"), std::pair(drive.alarm, "ALARM"),
        std::pair(drive.limit_positive, "P-OT"), std::pair(drive.limit_negative, "N-OT")}) {
    if (given) {
      flags += fmt::format(" {}", name);
    }
  }
  return fmt::format("  {} {:>9} counts {:>10.4f} mm {:>10} {:<12}", "xy"[axis], view.counts[axis],
                     static_cast<double>(view.counts[axis]) * mm_per_count,
                     view.vref[axis] ? fmt::format("{:.4f} V", *view.vref[axis]) : "- V",
                     flags.empty() ? " off" : flags);
}

Expected<void> monitor(const Options& options, const std::atomic<bool>& stop) {
  const auto rig_seen = open_to_look(options);
  if (!rig_seen) {
    return tl::unexpected(rig_seen.error());
  }
  const RigPorts& ports = rig_seen->ports;
  const hal::MachineInfo info = machine_info(rig_seen->machine);
  fmt::print("rig: {}; Ctrl-C ends this\n", describe(rig_seen->kind));
  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  const auto start = Clock::now();
  for (auto next = start; !stop.load(); next += kInterval) {
    std::this_thread::sleep_until(next);
    const double t = std::chrono::duration<double>(next - start).count();
    if (options.for_s && t > *options.for_s) {
      break;
    }
    const rig::RigView view = rig::look_at_rig(*ports.pci1716, *ports.pci1784, rig_seen->settings);
    if (view.board_id_1716 < 0 || view.board_id_1784 < 0) {
      return fail(ErrorCode::kMachine, "a card does not answer: all its registers read ones");
    }
    fmt::print("{}{:8.1f} s{}{}  DI {:#06x}{}", is_terminal ? "\r" : "", t,
               axis_text(hal::kX, view, info.mm_per_count[hal::kX]),
               axis_text(hal::kY, view, info.mm_per_count[hal::kY]), view.digital,
               is_terminal ? "" : "\n");
    std::fflush(stdout);
  }
  if (is_terminal) {
    fmt::print("\n");
  }
  return {};
}

}  // namespace

Command add_rig_monitor(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "monitor", "Show live counts, volts and inputs; nothing moves, a run may go on beside it");
  add_machine_options(*app, options);
  add_rig_options(*app, options, false);
  app->add_option("--for", options.for_s, "End after so long")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS");
  return {app, [&options, &stop = context.stop] { return monitor(options, stop); }};
}

}  // namespace twin::cli
