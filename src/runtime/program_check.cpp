#include "runtime/program_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "gcode/programmed_curve.hpp"
#include "results/metrics/block_distance.hpp"

namespace twin::runtime {
namespace {

constexpr double kRounding = 1e-9;  // [mm]
constexpr int kHalvings = 40;       // of a stretch of parameter

void include(const Vec3& point, Vec3& low, Vec3& high) {
  low = low.cwiseMin(point);
  high = high.cwiseMax(point);
}

/// A curve reaches furthest along an axis where C' has no part along it; its samples stand close
/// enough that one such place at most is between two of them.
void include_curve(const gcode::ProgrammedCurve& programmed, Vec3& low, Vec3& high) {
  const geometry::Curve& curve = programmed.curve;
  geometry::Derivatives before = curve.derivatives(programmed.samples.front().u);
  for (std::size_t i = 1; i < programmed.samples.size(); ++i) {
    const geometry::Derivatives here = curve.derivatives(programmed.samples[i].u);
    include(here.position, low, high);
    for (int axis = 0; axis < 3; ++axis) {
      if (before.first[axis] * here.first[axis] < 0.0) {
        double from = programmed.samples[i - 1].u;
        double to = programmed.samples[i].u;
        for (int halving = 0; halving < kHalvings; ++halving) {
          const double u = 0.5 * (from + to);
          const bool is_past = curve.derivatives(u).first[axis] * here.first[axis] > 0.0;
          (is_past ? to : from) = u;
        }
        include(curve.position(from), low, high);
      }
    }
    before = here;
  }
}

/// Corners of the box of one block. An arc reaches furthest along an axis where its tangent has no
/// part along it.
void include_block(const gcode::Block& block, Vec3& low, Vec3& high) {
  include(block.end, low, high);
  if (block.motion == gcode::Motion::kNurbs) {
    include_curve(*block.nurbs, low, high);
  }
  if (block.motion != gcode::Motion::kArc) {
    return;
  }
  const geometry::Arc& arc = block.arc;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = std::atan2(arc.e2[axis], arc.e1[axis]);
    for (int half_turn = -1; half_turn <= 3; ++half_turn) {
      const double angle = first + half_turn * std::numbers::pi;
      if (angle > 0.0 && angle < arc.sweep) {
        include(results::point_at(block, angle / arc.sweep), low, high);
      }
    }
  }
}

Expected<void> check_travel(const gcode::Block& block, const Vec3& low, const Vec3& high,
                            const Limits& limits, const std::string& file) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_low = low[axis] < limits.travel_min[axis] - kRounding;
    if (is_low || high[axis] > limits.travel_max[axis] + kRounding) {
      const double limit = is_low ? limits.travel_min[axis] : limits.travel_max[axis];
      const double place = is_low ? low[axis] : high[axis];
      return tl::unexpected(
          Error{ErrorCode::kProgram,
                fmt::format(
                    "axis {} would go to {:.4f} mm, its travel ends at {:g} mm; nothing was moved",
                    "XYZ"[axis], place, limit),
                file, static_cast<int>(block.line), 0});
    }
  }
  return {};
}

}  // namespace

Expected<ProgramFigures> check_program(const std::filesystem::path& program,
                                       const gcode::ReaderOptions& options, const Limits& limits) {
  auto reader = gcode::Reader::open(program.string(), options);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  ProgramFigures figures;
  figures.box_min = figures.box_max = options.start;
  for (;;) {
    auto block = reader->next();
    if (!block) {
      return tl::unexpected(block.error());
    }
    if (!block->has_value()) {
      break;
    }
    include_block(**block, figures.box_min, figures.box_max);
    if (auto inside =
            check_travel(**block, figures.box_min, figures.box_max, limits, program.string());
        !inside) {
      return tl::unexpected(inside.error());
    }
    if ((*block)->motion != gcode::Motion::kDwell) {
      ++figures.blocks;
      figures.length += results::block_length(**block, results::View::kSpace);
    }
  }
  figures.lines = reader->line();
  return figures;
}

}  // namespace twin::runtime
