#include "studies/identify/table_run.hpp"

#include <cmath>
#include <limits>

#include "gcode/reader.hpp"
#include "results/metrics/contour_tracker.hpp"
#include "results/metrics/running.hpp"
#include "studies/identify/axis_model.hpp"
#include "studies/identify/set_points.hpp"

namespace twin::studies::identify {

Expected<TableRun> TableRun::plan(const std::filesystem::path& program,
                                  const config::MachineFile& machine,
                                  std::optional<double> feedrate) {
  config::MachineFile published = machine;
  published.path.planner = Planner::kPaper;
  TWIN_TRY(const auto points, plan_set_points(program, published, feedrate));
  TableRun run;
  TWIN_TRY(auto reader, gcode::Reader::open(program.string()));
  for (;;) {
    TWIN_TRY(auto block, reader.next());
    if (!block.has_value()) {
      break;
    }
    run.blocks_.push_back(*block);
  }
  for (const motion::SetPoint& point : points) {
    run.on_block_.push_back(point.block);
    run.positions_.push_back(point.position);
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      run.references_[static_cast<std::size_t>(axis)].push_back(
          {point.position[axis], point.velocity[axis], point.acceleration[axis]});
    }
  }
  run.machining_time_ =
      points.empty() ? 0.0 : machine.period * static_cast<double>(points.size() - 1);
  return run;
}

RunErrors TableRun::run(const config::MachineFile& machine) const {
  RunErrors errors;
  std::array<AxisRun, 2> runs;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    runs[axis] = simulate(axis_setup(machine, axis), references_[axis]);
    const bool has_failed = runs[axis].has_failed;
    results::Running error;
    for (std::size_t k = 0; k < runs[axis].rows.size(); ++k) {
      error.add(std::abs(references_[axis][k].position - runs[axis].rows[k].encoder));
    }
    errors.axis_max[axis] = has_failed ? std::numeric_limits<double>::infinity() : error.max();
    errors.axis_rms[axis] = has_failed ? std::numeric_limits<double>::infinity() : error.rms();
    if (has_failed) {
      errors.contour_max = errors.contour_rms = std::numeric_limits<double>::infinity();
    }
  }
  if (std::isinf(errors.contour_max)) {
    return errors;
  }
  results::ContourTracker tracker(results::View::kAlongZ);
  results::Running contour;
  std::size_t next = 0;
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    while (next < blocks_.size() && !tracker.is_ready(on_block_[k])) {
      tracker.add(blocks_[next++]);
    }
    tracker.follow(on_block_[k], positions_[k]);
    contour.add(tracker.nearest({runs[0].rows[k].encoder, runs[1].rows[k].encoder, 0.0}).distance);
  }
  errors.contour_max = contour.max();
  errors.contour_rms = contour.rms();
  return errors;
}

}  // namespace twin::studies::identify
