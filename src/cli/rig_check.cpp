#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/rig_machines.hpp"
#include "runtime/pacer.hpp"
#include "studies/commissioning/wiring_check.hpp"

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

void print_axis(char name, const AxisWiringReport& report) {
  fmt::print("  {}  {:>10.3f} {:>10.2f} {:>12.3f} {:>12.3f}   {}\n", name, report.drift,
             report.offset() * 1e3, report.expected_scale, report.measured_scale,
             studies::commissioning::advice(report, std::string(1, name)));
}

Expected<void> check(const Options& options, const std::atomic<bool>& stop) {
  const auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  const auto opened = open_rig(options, *machine, "rig check moves each axis by about 0.6 mm and");
  if (!opened) {
    return tl::unexpected(opened.error());
  }
  hal::Machine& rig = **opened;
  const auto report = studies::commissioning::check_wiring(
      rig, {}, machine->period, make_wait(rig.info(), machine->period), stop);
  if (!report) {
    return tl::unexpected(report.error());
  }
  fmt::print("wiring check{}\n", rig.info().simulated ? " (simulated)" : "");
  fmt::print("  {:<3}{:>10} {:>10} {:>12} {:>12}\n", "", "drift", "offset", "expected", "measured");
  fmt::print("  {:<3}{:>10} {:>10} {:>12} {:>12}\n", "", "mm/s", "mV", "mm/s/V", "mm/s/V");
  std::string wrong;
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    print_axis("xy"[axis], (*report)[axis]);
    if ((*report)[axis].finding != studies::commissioning::Finding::kSound) {
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

}  // namespace

Command add_rig_check(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "check", "Static wiring test: sign, scale and offset of each axis by a tiny open-loop move");
  add_machine_options(*app, options);
  add_rig_options(*app, options, true);
  return {app, [&options, &stop = context.stop] { return check(options, stop); }};
}

}  // namespace twin::cli
