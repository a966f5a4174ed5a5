#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/rigs.hpp"
#include "core/units.hpp"
#include "runtime/pacer.hpp"
#include "session/axis_move.hpp"
#include "session/results.hpp"
#include "studies/commissioning/home_run.hpp"
#include "studies/commissioning/wiring_check.hpp"

// twin rig check, jog and home: single axes move.
namespace twin::cli {
namespace {

using studies::commissioning::AxisWiringReport;

/// Sleeps to the next period on the wall clock; nothing in simulated time.
studies::commissioning::WaitForPeriod make_wait(const hal::MachineInfo& info, double period) {
  if (!info.keeps_own_time) {
    return [] {};
  }
  const auto clock = std::make_shared<runtime::MonotonicClock>();
  const auto pacer = std::make_shared<runtime::Pacer>(*clock, period, RealtimeSettings{});
  return [clock, pacer] { pacer->wait(); };
}

void print_wiring(char name, const AxisWiringReport& report) {
  fmt::print("  {}  {:>10.3f} {:>10.2f} {:>12.3f} {:>12.3f}   {}\n", name, report.drift,
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
  fmt::print("wiring check{}\n", simulated_mark(rig));
  fmt::print("  {:<3}{:>10} {:>10} {:>12} {:>12}\n", "", "drift", "offset", "expected", "measured");
  fmt::print("  {:<3}{:>10} {:>10} {:>12} {:>12}\n", "", "mm/s", "mV", "mm/s/V", "mm/s/V");
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
                               environment.command_line};
  TWIN_TRY(const auto rig, open_rig(arguments.rig, machine,
                                    fmt::format("rig jog --axis {} --distance-mm {:g}",
                                                arguments.axis, move.distance)));
  TWIN_TRY(const auto result, session::make_axis_move(move, machine, *rig, environment.stop));
  if (result.failure) {
    return tl::unexpected(*result.failure);
  }
  if (arguments.results.verbosity == Verbosity::kNormal) {
    const auto& error = result.summary.run->tracking_error[move.axis];
    fmt::print(
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
      fmt::print("{}\n", line);
      std::fflush(stdout);
    }
  };
  TWIN_CHECK(studies::commissioning::run_homing(
      {axis_of(arguments.axis), machine, arguments.results.folder, environment.command_line}, *rig,
      tell, environment.stop));
  tell(fmt::format("axis {} stands at its zero{}: the next run begins there", arguments.axis,
                   simulated_mark(*rig)));
  return {};
}

}  // namespace twin::cli
