#include "studies/compensate/contour_path.hpp"

#include <utility>

#include "gcode/reader.hpp"
#include "results/metrics/contour_tracker.hpp"
#include "results/metrics/running.hpp"
#include "runtime/run_options.hpp"
#include "runtime/set_points.hpp"

namespace twin::studies::compensate {

Expected<ContourPath> ContourPath::plan(const gcode::ProgramText& program,
                                        const config::MachineFile& machine,
                                        const std::optional<double>& feedrate) {
  ContourPath path;
  gcode::Reader reader(program, runtime::reader_options(machine, feedrate));
  for (;;) {
    TWIN_TRY(std::optional<gcode::Block> block, reader.next());
    if (!block) {
      break;
    }
    path.blocks_.push_back(std::move(*block));
  }
  const auto set_points = runtime::SetPoints::open(program, machine, feedrate);
  motion::SetPoint point;
  while (set_points->next(point)) {
    path.points_.push_back(point);
  }
  if (set_points->error()) {
    return tl::unexpected(*set_points->error());
  }
  return path;
}

std::vector<std::size_t> ContourPath::blocks_of_periods() const {
  std::vector<std::size_t> blocks;
  blocks.reserve(points_.size());
  for (const motion::SetPoint& point : points_) {
    blocks.push_back(static_cast<std::size_t>(point.block));
  }
  return blocks;
}

std::vector<Vec2> ContourPath::errors(std::span<const Vec2> positions) const {
  results::ContourTracker tracker(results::View::kAlongZ);
  std::vector<Vec2> errors(points_.size(), Vec2::Zero());
  std::size_t next = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    while (next < blocks_.size() && !tracker.is_ready(points_[k].block)) {
      tracker.add(blocks_[next++]);
    }
    tracker.follow(points_[k].block, points_[k].position);
    const Vec3 position(positions[k].x(), positions[k].y(), 0.0);
    errors[k] = tracker.nearest(position).point.head<2>() - positions[k];
  }
  return errors;
}

results::ErrorStats stats_of(std::span<const Vec2> errors) {
  results::Running running;
  for (const Vec2& error : errors) {
    running.add(error.norm());
  }
  return {running.max(), running.rms()};
}

}  // namespace twin::studies::compensate
