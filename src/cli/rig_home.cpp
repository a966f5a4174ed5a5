#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/rig_machines.hpp"
#include "hal/kept_machine.hpp"
#include "session/axis_move.hpp"
#include "studies/commissioning/homing.hpp"

namespace twin::cli {
namespace {

using studies::commissioning::HomingMove;
using studies::commissioning::HomingStop;
using studies::commissioning::Until;

/// What the motion looks out for. A switch that opens ends a move by its monitor.
runtime::Until watch_for(const HomingMove& move) {
  const std::size_t axis = move.axis;
  switch (move.until) {
    case Until::kIndex:
      return [axis, is_positive = move.is_positive](const hal::Inputs& inputs) {
        return inputs.index[axis] &&
               !(is_positive ? inputs.limit_positive : inputs.limit_negative)[axis];
      };
    case Until::kNothing:
    case Until::kLimitReached:
      break;
  }
  return {};
}

/// True if a monitor ended the move because the switch that is sought has opened.
bool met_switch(const runtime::RunResult& result, const HomingMove& move) {
  const motion::Kind wanted =
      move.is_positive ? motion::Kind::kPositiveLimit : motion::Kind::kNegativeLimit;
  return move.until == Until::kLimitReached && result.trip && result.trip->axis == move.axis &&
         result.trip->kind == wanted;
}

/// Makes the moves of homing one after the other.
class Homing {
 public:
  Homing(const Options& options, config::MachineFile machine, hal::KeptMachine& rig,
         const std::atomic<bool>& stop)
      : options_(options), machine_(std::move(machine)), rig_(rig), stop_(stop) {
    // Nobody knows where the table stands: the switches are the only limits.
    const Vec3 far = 2.0 * (machine_.limits.travel_max - machine_.limits.travel_min);
    machine_.limits.travel_min = -far;
    machine_.limits.travel_max = far;
  }

  Expected<HomingStop> make(const HomingMove& wanted) {
    session::AxisMove move;
    move.name = "home";
    move.axis = wanted.axis;
    move.folder = options_.out;
    move.distance = wanted.distance;
    move.feedrate = wanted.feedrate;
    move.until = watch_for(wanted);
    if (!options_.quiet) {
      fmt::print("axis {}: {}\n", "xy"[move.axis], description(wanted));
      std::fflush(stdout);
    }
    const auto result = session::make_axis_move(move, machine_, rig_, stop_);
    if (!result) {
      return tl::unexpected(result.error());
    }
    const auto axis = static_cast<Eigen::Index>(wanted.axis);
    HomingStop stop{result->rest_at[axis] + rig_.come_to_rest()[wanted.axis], {}};
    if (met_switch(*result, wanted)) {
      stop.met_at = stop.position;
      return stop;
    }
    if (result->failure) {
      return tl::unexpected(*result->failure);
    }
    if (result->met_at) {
      stop.met_at = (*result->met_at)[axis];
    }
    return stop;
  }

 private:
  static std::string description(const HomingMove& move) {
    switch (move.until) {
      case Until::kLimitReached:
        return fmt::format("towards {}", move.is_positive ? "P-OT" : "N-OT");
      case Until::kIndex:
        return "off the switch and to the index";
      case Until::kNothing:
        break;
    }
    return fmt::format("{:+.4f} mm to zero", move.distance);
  }

  const Options& options_;
  config::MachineFile machine_;
  hal::KeptMachine& rig_;
  const std::atomic<bool>& stop_;
};

Expected<void> home(const Options& options, const std::atomic<bool>& stop) {
  const auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  const auto rig = open_rig(options, *machine,
                            fmt::format("rig home drives axis {} to its switch and", options.axis));
  if (!rig) {
    return tl::unexpected(rig.error());
  }
  const hal::Axis axis = options.axis == "x" ? hal::kX : hal::kY;
  const hal::mujoco::AxisParams& table = machine->table.axis[axis];
  hal::KeptMachine kept(**rig);
  Homing homing(options, *machine, kept, stop);
  const auto homed = studies::commissioning::home_axis(
      axis, machine->home[axis], 2.0 * table.travel, table.screw.lead,
      [&homing](const HomingMove& move) { return homing.make(move); });
  if (homed && !options.quiet) {
    fmt::print("axis {} stands at its zero{}: the next run begins there\n", options.axis,
               (*rig)->info().simulated ? " (simulated)" : "");
  }
  return homed;
}

}  // namespace

Command add_rig_home(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "home", "Find an axis' zero by limit switch and index, and drive there");
  add_axis_option(*app, options);
  add_machine_options(*app, options);
  add_rig_options(*app, options, true);
  app->add_option("--out", options.out, "Folder of the last move's trace [renders/rig_home]")
      ->type_name("DIR");
  app->add_flag("--quiet", options.quiet, "Print errors only");
  return {app, [&options, &stop = context.stop] { return home(options, stop); }};
}

}  // namespace twin::cli
