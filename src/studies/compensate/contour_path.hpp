#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/vec.hpp"
#include "gcode/block.hpp"
#include "gcode/program_text.hpp"
#include "motion/interpolator/set_point.hpp"
#include "results/metrics/summary.hpp"

namespace twin::studies::compensate {

/// A program with its set points, and how far from its path positions are.
class ContourPath {
 public:
  /// Reads and plans a program. @param feedrate  replaces the F words [mm/s]
  static Expected<ContourPath> plan(const gcode::ProgramText& program,
                                    const config::MachineFile& machine,
                                    const std::optional<double>& feedrate = {});

  /// One set point a period, without any correction.
  const std::vector<motion::SetPoint>& points() const noexcept { return points_; }

  /// The blocks of the program.
  const std::vector<gcode::Block>& blocks() const noexcept { return blocks_; }
  /// Number of the block that each set point is on.
  std::vector<std::size_t> blocks_of_periods() const;
  /// Whether a set point is on a block that is no rapid.
  bool is_feed(std::size_t period) const {
    const auto block = static_cast<std::size_t>(points_[period].block);
    return block >= blocks_.size() || blocks_[block].motion != gcode::Motion::kRapid;
  }
  /// From the first set point to the last [s]. @param period  [s]
  double time(double period) const {
    return points_.empty() ? 0.0 : period * static_cast<double>(points_.size() - 1);
  }

  /// What leads from each position to the nearest point of the programmed path, seen along Z
  /// (periods) [mm]. @param positions  as many as set points [mm]
  std::vector<Vec2> errors(std::span<const Vec2> positions) const;

 private:
  std::vector<gcode::Block> blocks_;
  std::vector<motion::SetPoint> points_;
};

/// Largest and root mean square length of error vectors [mm].
results::ErrorStats stats_of(std::span<const Vec2> errors);

}  // namespace twin::studies::compensate
