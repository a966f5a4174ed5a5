#include "runtime/planning.hpp"

#include <utility>

#include "feedrate/look_ahead.hpp"
#include "path/builder.hpp"

namespace twin::runtime {

void count(const path::Segment& segment, PlanFigures& figures) {
  figures.path_length += segment.length;
  if (std::holds_alternative<path::Line>(segment.geometry)) {
    ++figures.lines;
  } else if (std::holds_alternative<path::Arc>(segment.geometry)) {
    ++figures.arcs;
  } else if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    ++figures.curves;
    if (curve->is_programmed) {
      return;
    }
    ++figures.fitted_curves;
    for (const path::BlockMark& mark : segment.marks) {
      figures.short_length.add(mark.length);
    }
  }
}

Expected<PlanFigures> plan_program(gcode::Reader& reader, const config::MachineFile& machine,
                                   const std::function<bool(feedrate::PlannedSegment&&)>& sink) {
  PlanFigures figures;
  bool goes_on = true;
  feedrate::LookAhead look_ahead(machine.limits, machine.planning, machine.path, machine.period,
                                 [&](feedrate::PlannedSegment&& planned) {
                                   for (const feedrate::Phase& phase : planned.phases) {
                                     figures.time += phase.duration;
                                   }
                                   goes_on = goes_on && sink(std::move(planned));
                                 });
  const auto builder = path::make_builder(machine.path, machine.planning, machine.limits,
                                          [&](path::Segment&& segment) {
                                            count(segment, figures);
                                            look_ahead.push(std::move(segment));
                                          });
  while (goes_on) {
    auto block = reader.next();
    if (!block) {
      return tl::unexpected(block.error());
    }
    if (!block->has_value()) {
      break;
    }
    figures.blocks += (*block)->motion == gcode::Motion::kDwell ? 0 : 1;
    builder->push(**block);
  }
  if (goes_on) {
    builder->finish();
    look_ahead.finish();
  }
  figures.fallbacks = look_ahead.fallbacks();
  return figures;
}

void put_into(metrics::Summary& summary, const PlanFigures& figures) {
  const metrics::Running& lengths = figures.short_length;
  summary.blocks = {figures.blocks, lengths.count(), lengths.min(), lengths.mean(), lengths.max()};
  summary.segments = {figures.curves + figures.lines + figures.arcs, figures.curves, figures.lines,
                      figures.arcs};
  summary.compression_factor =
      figures.fitted_curves > 0
          ? static_cast<double>(lengths.count()) / static_cast<double>(figures.fitted_curves)
          : 1.0;
  summary.path_length = figures.path_length;
  summary.planned_time = figures.time;
}

}  // namespace twin::runtime
