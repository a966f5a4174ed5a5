#include "runtime/cycle_time.hpp"

namespace twin::runtime {

Expected<PlanFigures> estimate_plan(const std::filesystem::path& program,
                                    const gcode::ReaderOptions& options,
                                    const config::MachineFile& machine,
                                    const std::atomic<bool>* stop) {
  auto reader = gcode::Reader::open(program.string(), options);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  const auto goes_on = [stop] { return stop == nullptr || !stop->load(); };
  auto figures = plan_program(
      *reader, machine, [&](const feedrate::PlannedSegment& /*planned*/) { return goes_on(); });
  if (figures && !goes_on()) {
    return fail(ErrorCode::kInterrupted, "interrupted: nothing has moved");
  }
  return figures;
}

}  // namespace twin::runtime
