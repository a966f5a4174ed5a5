#include "runtime/program_bound.hpp"

#include <utility>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::runtime {

Expected<double> time_bound(const std::filesystem::path& program,
                            const config::MachineFile& machine,
                            const std::optional<double>& feedrate,
                            feedrate::TimeBound::Profile profile) {
  auto reader = gcode::Reader::open(program.string(), {.feedrate = feedrate});
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  feedrate::TimeBound bound(machine.limits, machine.planning, machine.path, machine.period,
                            std::move(profile));
  auto figures = plan_program(*reader, machine, [&](feedrate::PlannedSegment&& planned) {
    bound.add(planned);
    return true;
  });
  if (!figures) {
    return tl::unexpected(figures.error());
  }
  return bound.finish();
}

}  // namespace twin::runtime
