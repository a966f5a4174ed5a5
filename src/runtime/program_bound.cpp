#include "runtime/program_bound.hpp"

#include <utility>

#include "core/stop_wish.hpp"
#include "gcode/reader.hpp"
#include "runtime/planning.hpp"
#include "runtime/run_options.hpp"

namespace twin::runtime {

Expected<double> time_bound(const gcode::ProgramText& program, const config::MachineFile& machine,
                            const std::optional<double>& feedrate, const std::atomic<bool>* stop,
                            feedrate::TimeBound::Profile profile) {
  gcode::Reader reader(program, reader_options(machine, feedrate));
  feedrate::TimeBound bound(machine.limits, machine.planning, machine.path, machine.period,
                            std::move(profile));
  const auto wish = [stop] {
    return check_wish(stop, "interrupted: the bound of the time is not known");
  };
  TWIN_CHECK(plan_program(
      reader, machine,
      [&](feedrate::PlannedSegment&& planned) {
        bound.add(planned);
        return wish().has_value();
      },
      {}, PlanThreads::kBeside));
  TWIN_CHECK(wish());
  bound.finish();
  return bound.with_jerk();
}

}  // namespace twin::runtime
