#include "runtime/set_points.hpp"

#include <utility>

#include "runtime/run_options.hpp"

namespace twin::runtime {

std::unique_ptr<SetPoints> SetPoints::open(const gcode::ProgramText& program,
                                           const config::MachineFile& machine,
                                           const std::optional<double>& feedrate) {
  gcode::Reader reader(program, reader_options(machine, feedrate));
  return std::unique_ptr<SetPoints>(new SetPoints(std::move(reader), machine));
}

SetPoints::SetPoints(gcode::Reader&& reader, const config::MachineFile& machine)
    : machine_(machine),
      reader_(std::move(reader)),
      ramp_{.acceleration = machine.limits.acceleration, .jerk = machine.limits.jerk},
      planner_([this] { return reader_.next(); }, machine_, ProgramPlanner::Replans::kOnRequest),
      planning_(planner_, machine_),
      interpolator_(planning_, machine.period, machine.interpolation),
      feed_(interpolator_, planning_, planning_, panel_,
            {.schedule = {},
             .ramp = ramp_,
             .period = machine.period,
             .feedrate = machine.limits.feedrate}) {}

bool SetPoints::next(motion::SetPoint& out) {
  if (planning_.plan_ahead()) {
    feed_.update(time());
  } else {
    interpolator_.brake(ramp_);
  }
  switch (interpolator_.step(last_)) {
    case motion::Status::kMoving:
      break;
    case motion::Status::kAtRest:
      if (planning_.error()) {
        return false;
      }
      last_.velocity.setZero();
      last_.acceleration.setZero();
      last_.feedrate = 0.0;
      break;
    case motion::Status::kStarved:
    case motion::Status::kDone:
      return false;
  }
  ++periods_;
  out = last_;
  return true;
}

}  // namespace twin::runtime
