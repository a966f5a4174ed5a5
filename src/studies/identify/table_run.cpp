#include "studies/identify/table_run.hpp"

#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "gcode/reader.hpp"
#include "motion/interpolator/interpolator.hpp"
#include "results/metrics/contour_tracker.hpp"
#include "results/metrics/running.hpp"
#include "runtime/planning.hpp"
#include "studies/identify/axis_model.hpp"

namespace twin::studies::identify {
namespace {

/// Planned segments, one after the other.
class PlannedList final : public motion::SegmentSource {
 public:
  void push(feedrate::PlannedSegment&& segment) { segments_.push_back(std::move(segment)); }
  const feedrate::PlannedSegment* next() noexcept override {
    return next_ < segments_.size() ? &segments_[next_++] : nullptr;
  }
  void release(const feedrate::PlannedSegment* /*segment*/) noexcept override {}
  bool is_finished() const noexcept override { return next_ == segments_.size(); }

 private:
  std::deque<feedrate::PlannedSegment> segments_;
  std::size_t next_ = 0;
};

}  // namespace

Expected<TableRun> TableRun::plan(const gcode::ProgramText& program,
                                  const config::MachineFile& machine,
                                  std::optional<double> feedrate) {
  config::MachineFile published = machine;
  published.path.planner = Planner::kPaper;
  TWIN_TRY(const auto points, plan_set_points(program, published, feedrate));
  TableRun run;
  gcode::Reader reader(program);
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

Expected<std::vector<motion::SetPoint>> plan_set_points(const gcode::ProgramText& program,
                                                        const config::MachineFile& machine,
                                                        std::optional<double> feedrate) {
  gcode::ReaderOptions options;
  options.feedrate = feedrate;
  gcode::Reader reader(program, options);
  PlannedList list;
  TWIN_CHECK(runtime::plan_program(reader, machine, [&](feedrate::PlannedSegment&& planned) {
    list.push(std::move(planned));
    return true;
  }));
  motion::Interpolator interpolator(list, machine.period, machine.interpolation);
  std::vector<motion::SetPoint> points;
  motion::SetPoint point;
  while (interpolator.step(point) == motion::Status::kMoving) {
    points.push_back(point);
  }
  return points;
}

}  // namespace twin::studies::identify
