#include "studies/commissioning/home_run.hpp"

#include <fmt/format.h>

#include <utility>

#include "hal/kept_machine.hpp"
#include "session/axis_move.hpp"
#include "studies/commissioning/homing.hpp"

namespace twin::studies::commissioning {
namespace {

/// What the motion looks out for. A switch that opens ends a move by its monitor.
runtime::Until watch_for(const HomingMove& move) {
  if (move.until != Until::kIndex) {
    return {};
  }
  return [axis = move.axis, is_positive = move.is_positive](const hal::Inputs& inputs) {
    return inputs.index[axis] &&
           !(is_positive ? inputs.limit_positive : inputs.limit_negative)[axis];
  };
}

/// True if a monitor ended the move because the switch that is sought has opened.
bool met_switch(const runtime::RunResult& result, const HomingMove& move) {
  const motion::Kind wanted =
      move.is_positive ? motion::Kind::kPositiveLimit : motion::Kind::kNegativeLimit;
  return move.until == Until::kLimitReached && result.trip && result.trip->axis == move.axis &&
         result.trip->kind == wanted;
}

std::string description(const HomingMove& move) {
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

/// The machine file for moves from an unknown place.
config::MachineFile without_travel_limits(config::MachineFile machine) {
  const Vec3 far = 2.0 * (machine.limits.travel_max - machine.limits.travel_min);
  machine.limits.travel_min = -far;
  machine.limits.travel_max = far;
  return machine;
}

/// Makes one move and says where it ended.
Expected<HomingStop> make_homing_move(const HomingMove& wanted, const HomeRun& run,
                                      hal::KeptMachine& hal, const std::atomic<bool>& stop) {
  session::AxisMove move;
  move.name = "home";
  move.axis = wanted.axis;
  move.distance = wanted.distance;
  move.feedrate = wanted.feedrate;
  move.folder = run.folder;
  move.command = run.command;
  move.until = watch_for(wanted);
  TWIN_TRY(const runtime::RunResult result, session::make_axis_move(move, run.machine, hal, stop));
  if (result.failure && !met_switch(result, wanted)) {
    return tl::unexpected(*result.failure);
  }
  const auto axis = static_cast<Eigen::Index>(wanted.axis);
  HomingStop end{result.rest_at[axis] + hal.come_to_rest()[wanted.axis], {}};
  if (met_switch(result, wanted)) {
    end.met_at = end.position;
    return end;
  }
  if (result.met_at) {
    end.met_at = (*result.met_at)[axis];
  }
  return end;
}

}  // namespace

Expected<void> run_homing(const HomeRun& run, hal::Machine& hal,
                          const std::function<void(const std::string&)>& tell,
                          const std::atomic<bool>& stop) {
  const HomeRun moves{run.axis, without_travel_limits(run.machine), run.folder, run.command};
  const hal::mujoco::AxisParams& table = run.machine.table.axis[run.axis];
  hal::KeptMachine kept(hal);
  return home_axis(run.axis, run.machine.home[run.axis], 2.0 * table.travel, table.screw.lead,
                   [&](const HomingMove& move) {
                     tell(fmt::format("axis {}: {}", "xy"[move.axis], description(move)));
                     return make_homing_move(move, moves, kept, stop);
                   });
}

}  // namespace twin::studies::commissioning
