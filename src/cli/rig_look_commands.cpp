#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <utility>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/rigs.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/cards.hpp"
#include "hal/rig/io_port/find_card.hpp"

// twin rig probe and monitor: the rig is looked at and nothing moves.
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

std::string signal(const rig::Line& line, bool given, const char* yes, const char* no) {
  return line.channel < 0 ? "not wired" : given ? yes : no;
}

void print_cards(const rig::io_port::CardKind& kind, const rig::RigSettings& settings) {
  for (const rig::io_port::CardSeen& card :
       rig::io_port::look_for_cards(kind, settings.access, settings.sysfs)) {
    fmt::print("  {:<10}{}, {}\n", kind.name, card.pci.address,
               card.why.empty() ? fmt::format("board ID {}, {}", card.board_id, to_text(card.port))
                                : card.why);
  }
}

void print_axis(char name, const rig::AxisWiring& wiring, const rig::RigView& view,
                std::size_t axis) {
  const rig::DriveInputs& drive = view.drives[axis];
  fmt::print("  axis {}    DAC {}, counter {}: {} counts\n", name, wiring.dac, wiring.counter,
             view.counts[axis]);
  fmt::print("            ALM {}, servo ready {}, P-OT {}, N-OT {}, V-REF {}\n",
             signal(wiring.alarm, drive.alarm, "ALARM (or wire open)", "no alarm"),
             signal(wiring.ready, drive.ready, "yes", "no"),
             signal(wiring.limit_positive, drive.limit_positive, "REACHED (or wire open)", "free"),
             signal(wiring.limit_negative, drive.limit_negative, "REACHED (or wire open)", "free"),
             view.vref[axis] ? fmt::format("{:.4f} V", *view.vref[axis]) : "not read back");
}

}  // namespace

Expected<void> execute(const RigProbeArguments& arguments, const Environment&) {
  TWIN_TRY(auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  TWIN_TRY(const RigToLookAt rig_seen, open_to_look(arguments.rig, std::move(machine)));
  const rig::RigSettings& settings = rig_seen.settings;
  fmt::print("rig: {}\n", describe(rig_seen.kind));
  if (rig_seen.kind == rig::assemble::RigKind::kCards) {
    print_cards(rig::io_port::kPci1716, settings);
    print_cards(rig::io_port::kPci1784, settings);
  }
  const rig::RigView view =
      rig::look_at_rig(*rig_seen.ports.pci1716, *rig_seen.ports.pci1784, settings);
  fmt::print(
      "  PCI-1716  board ID {}, converters used at +-10 V (their registers cannot be read), "
      "DI {:#06x}\n",
      view.board_id_1716, view.digital);
  fmt::print("  PCI-1784  board ID {}\n", view.board_id_1784);
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    print_axis("xy"[axis], settings.axis[axis], view, axis);
  }
  if (view.board_id_1716 < 0 || view.board_id_1784 < 0) {
    return fail(ErrorCode::kMachine, fmt::format("the PCI-{} does not answer: all its registers "
                                                 "read ones",
                                                 view.board_id_1716 < 0 ? 1716 : 1784));
  }
  return {};
}

Expected<void> execute(const RigMonitorArguments& arguments, const Environment& environment) {
  TWIN_TRY(auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  TWIN_TRY(const RigToLookAt rig_seen, open_to_look(arguments.rig, std::move(machine)));
  const rig::assemble::RigPorts& ports = rig_seen.ports;
  const hal::MachineInfo info =
      rig::assemble::rig_info(rig_seen.machine.rig, rig_seen.machine.table);
  fmt::print("rig: {}; Ctrl-C ends this\n", describe(rig_seen.kind));
  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  const auto start = Clock::now();
  for (auto next = start; !environment.stop.load(); next += kInterval) {
    std::this_thread::sleep_until(next);
    const double t = std::chrono::duration<double>(next - start).count();
    if (arguments.duration && t > *arguments.duration) {
      break;
    }
    const rig::RigView view = rig::look_at_rig(*ports.pci1716, *ports.pci1784, rig_seen.settings);
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

}  // namespace twin::cli
