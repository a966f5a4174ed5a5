#include "runtime/program_bound.hpp"

#include <utility>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::runtime {

Expected<double> time_bound(const gcode::ProgramText& program, const config::MachineFile& machine,
                            const std::optional<double>& feedrate,
                            feedrate::TimeBound::Profile profile) {
  gcode::Reader reader(program, {.feedrate = feedrate});
  feedrate::TimeBound bound(machine.limits, machine.planning, machine.path, machine.period,
                            std::move(profile));
  TWIN_CHECK(plan_program(reader, machine, [&](feedrate::PlannedSegment&& planned) {
    bound.add(planned);
    return true;
  }));
  return bound.finish();
}

}  // namespace twin::runtime
