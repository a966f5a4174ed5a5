#include "runtime/planning.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "feedrate/look_ahead.hpp"
#include "feedrate/planner.hpp"

namespace twin::runtime {
namespace {

/// Non-empty spans of a curve.
std::int64_t count_spans(const geometry::Curve& curve) {
  const std::vector<double>& knots = curve.knots();
  return std::transform_reduce(knots.begin() + 1, knots.end(), knots.begin(), std::int64_t{0},
                               std::plus<>(),
                               [](double to, double from) { return from < to ? 1 : 0; });
}

}  // namespace

void count(const path::Segment& segment, double short_block_length, PlanFigures& figures) {
  figures.deviation = std::max(figures.deviation, segment.deviation);
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
    figures.spans += count_spans(curve->curve);
    for (const path::BlockMark& mark : segment.marks) {
      if (mark.block > figures.last_short && mark.length <= short_block_length) {
        figures.short_length.add(mark.length);
        figures.last_short = mark.block;
      }
    }
  }
}

Expected<PlanFigures> plan_program(
    gcode::Reader& reader, const config::MachineFile& machine,
    const std::function<bool(feedrate::PlannedSegment&&)>& sink,
    const std::function<Expected<void>(const gcode::Block&)>& inspect) {
  PlanFigures figures;
  bool goes_on = true;
  feedrate::LookAhead look_ahead(machine.limits, machine.planning, machine.path, machine.period,
                                 [&](feedrate::PlannedSegment&& planned) {
                                   for (const feedrate::Phase& phase : planned.phases) {
                                     figures.time += phase.duration;
                                   }
                                   goes_on = goes_on && sink(std::move(planned));
                                 });
  const auto planner =
      feedrate::make_planner(machine.limits, machine.planning, machine.path, machine.period);
  const auto builder = planner->make_builder([&](path::Segment&& segment) {
    count(segment, machine.path.short_block_length, figures);
    look_ahead.push(std::move(segment));
  });
  while (goes_on) {
    TWIN_TRY(const std::optional<gcode::Block> block, reader.next());
    if (!block) {
      break;
    }
    if (inspect) {
      TWIN_CHECK(inspect(*block));
    }
    figures.blocks += block->motion == gcode::Motion::kDwell ? 0 : 1;
    builder->push(*block);
  }
  if (goes_on) {
    builder->finish();
    look_ahead.finish();
  }
  figures.fallbacks = look_ahead.fallbacks();
  return figures;
}

void put_into(results::Summary& summary, const PlanFigures& figures, Planner planner) {
  const results::Running& lengths = figures.short_length;
  summary.blocks = {figures.blocks, lengths.count(), lengths.min(), lengths.mean(), lengths.max()};
  summary.segments = {figures.curves + figures.lines + figures.arcs, figures.curves, figures.lines,
                      figures.arcs};
  if (planner == Planner::kCertified) {
    summary.certified = {figures.deviation, figures.spans};
  }
  summary.compression_factor =
      figures.fitted_curves > 0 && lengths.count() > 0
          ? static_cast<double>(lengths.count()) / static_cast<double>(figures.fitted_curves)
          : 1.0;
  summary.path_length = figures.path_length;
  summary.planned_time = figures.time;
  summary.plan_fallbacks = figures.fallbacks;
}

}  // namespace twin::runtime
