#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "core/units.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/cards.hpp"
#include "hal/rig/emulator/serve.hpp"
#include "hal/rig/io_port/find_card.hpp"
#include "runtime/pacer.hpp"
#include "runtime/realtime_thread.hpp"
#include "session/axis_move.hpp"
#include "session/results.hpp"
#include "studies/commissioning/home_run.hpp"
#include "studies/commissioning/wiring_check.hpp"

// The commands of twin rig.
namespace twin::cli {

// Probe and monitor: the rig is looked at and nothing moves.

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

/// The same in less room: "  x 1234 8.339 mm 0.01 V ready".
std::string short_axis_text(std::size_t axis, const rig::RigView& view, double mm_per_count) {
  const rig::DriveInputs& drive = view.drives[axis];
  const char* const state = drive.alarm            ? "ALARM"
                            : drive.limit_positive ? "P-OT"
                            : drive.limit_negative ? "N-OT"
                            : drive.ready          ? "ready"
                                                   : "off";
  return fmt::format("  {} {:>8.3f} mm {:>6} V {:<5}", "xy"[axis],
                     static_cast<double>(view.counts[axis]) * mm_per_count,
                     view.vref[axis] ? fmt::format("{:.2f}", *view.vref[axis]) : "-", state);
}

/// One line of the monitor that fits into a terminal. @param columns  0: no terminal
std::string monitor_line(double t, const rig::RigView& view, const hal::MachineInfo& info,
                         std::size_t columns) {
  const auto line = [&](auto&& of_axis) {
    return of_axis(hal::kX, view, info.mm_per_count[hal::kX]) +
           of_axis(hal::kY, view, info.mm_per_count[hal::kY]);
  };
  std::string text = fmt::format("{:8.1f} s{}  DI {:#06x}", t, line(axis_text), view.digital);
  if (columns > 0 && text.size() >= columns) {
    text = fmt::format("{:.1f} s{}", t, line(short_axis_text));
  }
  return columns > 0 ? text.substr(0, columns - 1) : text;
}

std::string signal(const rig::Line& line, bool given, const char* yes, const char* no) {
  return line.channel < 0 ? "not wired" : given ? yes : no;
}

void print_cards(const rig::io_port::CardKind& kind, const rig::RigSettings& settings) {
  for (const rig::io_port::CardSeen& card :
       rig::io_port::look_for_cards(kind, settings.access, settings.sysfs)) {
    print_out("  {:<10}{}, {}\n", kind.name, card.pci.address,
              card.why.empty() ? fmt::format("board ID {}, {}", card.board_id, to_text(card.port))
                               : card.why);
  }
}

void print_axis(char name, const rig::AxisWiring& wiring, const rig::RigView& view,
                std::size_t axis) {
  const rig::DriveInputs& drive = view.drives[axis];
  print_out("  axis {}    DAC {}, counter {}: {} counts\n", name, wiring.dac, wiring.counter,
            view.counts[axis]);
  print_out("            ALM {}, servo ready {}, P-OT {}, N-OT {}, V-REF {}\n",
            signal(wiring.alarm, drive.alarm, "ALARM (or wire open)", "no alarm"),
            signal(wiring.ready, drive.ready, "yes", "no"),
            signal(wiring.limit_positive, drive.limit_positive, "REACHED (or wire open)", "free"),
            signal(wiring.limit_negative, drive.limit_negative, "REACHED (or wire open)", "free"),
            view.vref[axis] ? fmt::format("{:.4f} V", *view.vref[axis]) : "not read back");
}

/// "  x        0 counts     0.0000 mm   servo ready no, ALM no alarm, P-OT free, N-OT free".
std::string pin_text(std::size_t axis, const hal::Inputs& inputs, const hal::MachineInfo& info) {
  return fmt::format(
      "  {} {:>9} counts {:>10.4f} mm  servo ready {}, {}, P-OT {}, N-OT {}", "xy"[axis],
      inputs.counts[axis], static_cast<double>(inputs.counts[axis]) * info.mm_per_count[axis],
      inputs.servo_ready[axis] ? "yes" : "no", inputs.alarm[axis] ? "ALARM" : "no alarm",
      inputs.limit_positive[axis] ? "REACHED" : "free",
      inputs.limit_negative[axis] ? "REACHED" : "free");
}

/// What LinuxCNC's HAL shows of its machine, every `kInterval` of it until the end; nothing moves.
///
/// @param duration  [s]; 0: once
Expected<void> show_linuxcnc(const RigArguments& arguments, const config::MachineFile& file,
                             std::optional<double> duration, const std::atomic<bool>& stop) {
  const auto machine = make_linuxcnc_machine(arguments, file);
  TWIN_CHECK(checked(machine->configure(file.period)));
  const auto periods = std::max(1L, std::lround(0.1 / file.period));
  for (long i = 0; !stop.load(); ++i) {
    const double t = static_cast<double>(i) * file.period;
    if (duration && i > 0 && t > *duration) {
      break;
    }
    hal::Inputs inputs;
    if (machine->read(inputs) != hal::Status::kOk) {
      return fail(ErrorCode::kMachine, machine->last_error());
    }
    if (i % periods == 0) {
      print_out("{:8.1f} s{}{}\n", t, pin_text(hal::kX, inputs, machine->info()),
                pin_text(hal::kY, inputs, machine->info()));
      TWIN_CHECK(finish_output());
    }
  }
  return {};
}

}  // namespace

Expected<void> execute(const RigProbeArguments& arguments, const Environment& environment) {
  TWIN_TRY(auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  if (arguments.rig.which == kLinuxCnc) {
    print_out("rig: what LinuxCNC's HAL drives\n");
    return show_linuxcnc(arguments.rig, machine, 0.0, environment.stop);
  }
  TWIN_TRY(const RigToLookAt rig_seen, open_to_look(arguments.rig, std::move(machine)));
  const rig::RigSettings& settings = rig_seen.settings;
  print_out("rig: {}\n", describe(rig_seen.kind));
  if (rig_seen.kind == rig::assemble::RigKind::kCards) {
    print_cards(rig::io_port::kPci1716, settings);
    print_cards(rig::io_port::kPci1784, settings);
  }
  const rig::RigView view =
      rig::look_at_rig(*rig_seen.ports.pci1716, *rig_seen.ports.pci1784, settings);
  print_out(
      "  PCI-1716  board ID {}, converters used at +-10 V (their registers cannot be read), "
      "DI {:#06x}\n",
      view.board_id_1716, view.digital);
  print_out("  PCI-1784  board ID {}\n", view.board_id_1784);
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
  if (arguments.rig.which == kLinuxCnc) {
    print_out("rig: what LinuxCNC's HAL drives; Ctrl-C ends this\n");
    return show_linuxcnc(arguments.rig, machine, arguments.duration, environment.stop);
  }
  TWIN_TRY(const RigToLookAt rig_seen, open_to_look(arguments.rig, std::move(machine)));
  const rig::assemble::RigPorts& ports = rig_seen.ports;
  const hal::MachineInfo info =
      rig::assemble::rig_info(rig_seen.machine.rig, rig_seen.machine.table);
  print_out("rig: {}; Ctrl-C ends this\n", describe(rig_seen.kind));
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
    const std::string line =
        monitor_line(t, view, info, is_terminal ? columns_of(STDOUT_FILENO) : 0);
    print_out("{}{}{}", is_terminal ? "\r" : "", line, is_terminal ? "\033[K" : "\n");
    TWIN_CHECK(finish_output());
  }
  if (is_terminal) {
    print_out("\n");
  }
  return {};
}

// Check, jog and home: single axes move.

namespace {

using studies::commissioning::AxisWiringReport;

/// Sleeps to the next period on the wall clock; nothing in simulated time, or where reading waits.
studies::commissioning::WaitForPeriod make_wait(const hal::MachineInfo& info, double period) {
  if (!info.keeps_own_time || info.gives_beat) {
    return [] {};
  }
  const auto clock = std::make_shared<runtime::MonotonicClock>();
  const auto pacer = std::make_shared<runtime::Pacer>(*clock, period, RealtimeSettings{});
  return [clock, pacer] { pacer->wait(); };
}

void print_wiring(char name, const AxisWiringReport& report) {
  print_out("  {}  {:>10.3f} {:>10.2f} {:>12.3f} {:>12.3f}   {}\n", name, report.drift,
            report.offset() * 1e3, report.expected_scale, report.measured_scale,
            studies::commissioning::advice(report, std::string(1, name)));
}

const char* simulated_mark(const hal::Machine& machine) {
  return machine.info().simulated ? " (simulated)" : "";
}

}  // namespace

Expected<void> execute(const RigCheckArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  TWIN_TRY(const auto opened,
           open_rig(arguments.rig, machine, "rig check moves each axis by about 0.6 mm and"));
  hal::Machine& rig = *opened;
  TWIN_TRY(const auto report,
           studies::commissioning::check_wiring(
               rig, {}, machine.period, make_wait(rig.info(), machine.period), environment.stop));
  print_out("wiring check{}\n", simulated_mark(rig));
  print_out("  {:<3}{:>10} {:>10} {:>12} {:>12}\n", "", "drift", "offset", "expected", "measured");
  print_out("  {:<3}{:>10} {:>10} {:>12} {:>12}\n", "", "mm/s", "mV", "mm/s/V", "mm/s/V");
  std::string wrong;
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    print_wiring("xy"[axis], report[axis]);
    if (report[axis].finding != studies::commissioning::Finding::kSound) {
      wrong += wrong.empty() ? "" : " and ";
      wrong += "xy"[axis];
    }
  }
  if (!wrong.empty()) {
    return fail(ErrorCode::kMachine,
                fmt::format("axis {} must be put right before a loop is closed", wrong));
  }
  return {};
}

Expected<void> execute(const RigJogArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.results.verbosity));
  if (arguments.distance == 0.0) {
    return fail(ErrorCode::kUsage, "--distance-mm 0 is no move");
  }
  const session::AxisMove move{"jog",
                               axis_of(arguments.axis),
                               arguments.distance,
                               arguments.feedrate.value(),
                               arguments.results.folder,
                               environment.command_line,
                               {},
                               arguments.results.trace};
  TWIN_TRY(const auto rig, open_rig(arguments.rig, machine,
                                    fmt::format("rig jog --axis {} --distance-mm {:g}",
                                                arguments.axis, move.distance)));
  TWIN_TRY(const auto result, session::make_axis_move(move, machine, *rig, environment.stop));
  if (result.failure) {
    return tl::unexpected(*result.failure);
  }
  if (arguments.results.verbosity == Verbosity::kNormal) {
    const auto& error = result.summary.run->tracking_error[move.axis];
    print_out(
        "axis {} jogged by {:g} mm{}: tracking error max {:.1f}, RMS {:.1f} um; trace in {}\n",
        arguments.axis, move.distance, simulated_mark(*rig), units::um_from_mm(error.max),
        units::um_from_mm(error.rms), session::result_folder(move.folder, "rig_jog").string());
  }
  return {};
}

Expected<void> execute(const RigHomeArguments& arguments, const Environment& environment) {
  const Verbosity verbosity = arguments.results.verbosity;
  TWIN_TRY(const auto machine, read_machine(arguments.machine, verbosity));
  TWIN_TRY(const auto rig,
           open_rig(arguments.rig, machine,
                    fmt::format("rig home drives axis {} to its switch and", arguments.axis)));
  const auto tell = [verbosity](const std::string& line) {
    if (verbosity == Verbosity::kNormal) {
      print_out("{}\n", line);
      static_cast<void>(finish_output());
    }
  };
  TWIN_CHECK(studies::commissioning::run_homing(
      {axis_of(arguments.axis), machine, arguments.results.folder, environment.command_line}, *rig,
      tell, environment.stop));
  tell(fmt::format("axis {} stands at its zero{}: the next run begins there", arguments.axis,
                   simulated_mark(*rig)));
  return {};
}

// Emulate: a rig for other processes.

Expected<void> execute(const RigEmulateArguments& arguments, const Environment& environment) {
  TWIN_TRY(auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  TWIN_TRY(machine.table.changes, read_changes(arguments.rig.changes));
  rig::emulator::ServeSettings settings;
  settings.name = shared_name(arguments.rig);
  settings.duration = arguments.duration;
  for (const std::string& text : arguments.rig.faults) {
    TWIN_TRY(const auto fault, rig::emulator::parse_fault(text));
    settings.faults.push_back(fault);
  }
  const auto tell = [](std::string_view line) {
    print_out("{}\n", line);
    static_cast<void>(finish_output());
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
