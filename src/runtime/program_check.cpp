#include "runtime/program_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/stop_wish.hpp"
#include "gcode/block.hpp"
#include "gcode/start.hpp"
#include "results/metrics/block_distance.hpp"

namespace twin::runtime {
namespace {

constexpr const char* kNothingMoved = "interrupted: nothing has moved";
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
    const int last = 3 + static_cast<int>(arc.sweep / std::numbers::pi);
    for (int half_turn = -1; half_turn <= last; ++half_turn) {
      const double angle = first + half_turn * std::numbers::pi;
      if (angle > 0.0 && angle < arc.sweep) {
        include(results::point_at(block, angle / arc.sweep), low, high);
      }
    }
  }
}

/// Reads on to the program's end and checks every block.
Expected<void> check_rest(gcode::Reader& reader, TravelCheck& check,
                          const std::atomic<bool>* stop) {
  for (;;) {
    TWIN_CHECK(check_wish(stop, kNothingMoved));
    TWIN_TRY(const std::optional<gcode::Block> block, reader.next());
    if (!block) {
      return {};
    }
    TWIN_CHECK(check.add(*block));
  }
}

}  // namespace

TravelCheck::TravelCheck(std::string file, const Vec3& start, const Limits& limits)
    : file_(std::move(file)), limits_(limits) {
  figures_.box_min = figures_.box_max = figures_.end = start;
}

Expected<void> TravelCheck::add(const gcode::Block& block) {
  const Vec3& low = figures_.box_min;
  const Vec3& high = figures_.box_max;
  include_block(block, figures_.box_min, figures_.box_max);
  figures_.end = block.end;
  if (block.motion != gcode::Motion::kDwell) {
    ++figures_.blocks;
    figures_.length += results::block_length(block, results::View::kSpace);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_low = low[axis] < limits_.travel_min[axis] - kRounding;
    const bool is_high = high[axis] > limits_.travel_max[axis] + kRounding;
    auto& told = is_told_[static_cast<std::size_t>(axis)];
    if ((is_low && !told[0]) || (is_high && !told[1])) {
      const bool is_at_low = is_low && !told[0];
      told[is_at_low ? 0 : 1] = true;
      const double limit = is_at_low ? limits_.travel_min[axis] : limits_.travel_max[axis];
      const double place = is_at_low ? low[axis] : high[axis];
      return tl::unexpected(
          Error{.code = ErrorCode::kProgram,
                .message = fmt::format(
                    "axis {} would go to {:.4f} mm, its travel ends at {:g} mm; nothing was moved",
                    "XYZ"[axis], place, limit),
                .file = file_,
                .line = static_cast<int>(block.line)});
    }
  }
  return {};
}

Expected<ProgramFigures> check_program(const gcode::ProgramText& program,
                                       const gcode::ReaderOptions& options, const Limits& limits,
                                       const std::atomic<bool>* stop) {
  gcode::Reader reader(program, options);
  TravelCheck check(program.file().string(), gcode::start_of(program, options), limits);
  TWIN_CHECK(check_rest(reader, check, stop));
  ProgramFigures figures = check.figures();
  figures.lines = reader.line();
  figures.notes = reader.notes().all();
  return figures;
}

Expected<Estimate> estimate_program(const gcode::ProgramText& program,
                                    const gcode::ReaderOptions& options,
                                    const config::MachineFile& machine,
                                    const std::atomic<bool>* stop,
                                    const std::function<bool(feedrate::PlannedSegment&&)>& listen) {
  gcode::Reader reader(program, options);
  TravelCheck check(program.file().string(), gcode::start_of(program, options), machine.limits);
  Estimate estimate;
  const auto sink = [&](feedrate::PlannedSegment&& planned) {
    estimate.is_whole = estimate.is_whole && (!listen || listen(std::move(planned)));
    return estimate.is_whole && check_wish(stop, kNothingMoved);
  };
  TWIN_TRY(estimate.plan,
           plan_program(
               reader, machine, sink,
               [&](const gcode::Block& block) {
                 return check_wish(stop, kNothingMoved).and_then([&] { return check.add(block); });
               },
               PlanThreads::kBeside));
  if (!estimate.is_whole) {
    TWIN_CHECK(check_rest(reader, check, stop));
  }
  TWIN_CHECK(check_wish(stop, kNothingMoved));
  estimate.program = check.figures();
  estimate.program.lines = reader.line();
  estimate.program.notes = reader.notes().all();
  return estimate;
}

}  // namespace twin::runtime
