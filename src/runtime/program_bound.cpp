#include "runtime/program_bound.hpp"

#include <utility>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::runtime {

Expected<double> time_bound(const gcode::ProgramText& program, const config::MachineFile& machine,
                            const std::optional<double>& feedrate, const std::atomic<bool>* stop,
                            feedrate::TimeBound::Profile profile) {
  gcode::Reader reader(program, {.feedrate = feedrate});
  feedrate::TimeBound bound(machine.limits, machine.planning, machine.path, machine.period,
                            std::move(profile));
  const auto is_stopped = [stop] { return stop != nullptr && stop->load(); };
  TWIN_CHECK(plan_program(reader, machine, [&](feedrate::PlannedSegment&& planned) {
    if (is_stopped()) {
      return false;
    }
    bound.add(planned);
    return true;
  }));
  if (is_stopped()) {
    return fail(ErrorCode::kInterrupted, "interrupted: the bound of the time is not known");
  }
  return bound.finish();
}

}  // namespace twin::runtime
