#include "runtime/planning.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <thread>
#include <utility>

#include "feedrate/look_ahead.hpp"
#include "feedrate/planner.hpp"
#include "runtime/path_threads.hpp"

namespace twin::runtime {
namespace {

/// Blocks of a program that are planned before threads are started for the rest: what takes about a
/// millisecond, so that starting them never costs a tenth of the time.
constexpr std::int64_t kBlocksHere = 2000;

/// Non-empty spans of a curve.
std::int64_t count_spans(const geometry::Curve& curve) {
  const std::vector<double>& knots = curve.knots();
  return std::transform_reduce(knots.begin() + 1, knots.end(), knots.begin(), std::int64_t{0},
                               std::plus<>(),
                               [](double to, double from) { return from < to ? 1 : 0; });
}

/// A program on its way from text to planned segments.
class PlanChain {
 public:
  using Sink = std::function<bool(feedrate::PlannedSegment&&)>;
  using Inspect = std::function<Expected<void>(const gcode::Block&)>;

  PlanChain(gcode::Reader& reader, const config::MachineFile& machine, const Sink& sink,
            const Inspect& inspect)
      : reader_(reader),
        inspect_(inspect),
        short_block_length_(machine.path.short_block_length),
        look_ahead_(machine.limits, machine.planning, machine.path, machine.period,
                    [this, &sink](feedrate::PlannedSegment&& planned) {
                      for (const feedrate::Phase& phase : planned.phases) {
                        figures_.time += phase.duration;
                      }
                      goes_on_ = goes_on_ && sink(std::move(planned));
                    }),
        builder_(
            feedrate::make_planner(machine.limits, machine.planning, machine.path, machine.period)
                ->make_builder([this](path::Segment&& segment) {
                  beside_ ? beside_->push(std::move(segment)) : add(std::move(segment));
                })) {}

  /// Plans up to so many blocks in this thread.
  Expected<void> plan_here(std::int64_t most) {
    for (; goes_on_ && most > 0; --most) {
      TWIN_TRY(const std::optional<gcode::Block> block, read());
      if (!block) {
        builder_->finish();
        is_built_ = true;
        return {};
      }
      builder_->push(*block);
    }
    return {};
  }

  /// Plans the rest, with reading and path building in threads of their own.
  Expected<void> plan_beside() {
    if (!goes_on_ || is_built_) {
      return {};
    }
    beside_ = std::make_unique<PathThreads>([this] { return read(); }, *builder_);
    beside_->start();
    for (path::Segment* segment = nullptr; goes_on_ && (segment = beside_->next()) != nullptr;) {
      add(std::move(*segment));
    }
    return beside_->join();
  }

  PlanFigures finish() {
    if (goes_on_) {
      look_ahead_.finish();
    }
    figures_.blocks = blocks_;
    figures_.fallbacks = look_ahead_.fallbacks();
    return figures_;
  }

 private:
  Expected<std::optional<gcode::Block>> read() {
    TWIN_TRY(std::optional<gcode::Block> block, reader_.next());
    if (block && inspect_) {
      TWIN_CHECK(inspect_(*block));
    }
    blocks_ += block && block->motion != gcode::Motion::kDwell ? 1 : 0;
    return block;
  }

  void add(path::Segment&& segment) {
    count(segment, short_block_length_, figures_);
    look_ahead_.push(std::move(segment));
  }

  gcode::Reader& reader_;
  const Inspect& inspect_;
  double short_block_length_;
  PlanFigures figures_;
  std::int64_t blocks_ = 0;  // of the thread that reads
  bool goes_on_ = true;
  bool is_built_ = false;
  feedrate::LookAhead look_ahead_;
  std::unique_ptr<path::Builder> builder_;
  std::unique_ptr<PathThreads> beside_;  // ends before what its threads use
};

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
    const std::function<Expected<void>(const gcode::Block&)>& inspect, PlanThreads threads) {
  const bool is_beside = threads == PlanThreads::kBeside && std::thread::hardware_concurrency() > 1;
  PlanChain chain(reader, machine, sink, inspect);
  TWIN_CHECK(chain.plan_here(is_beside ? kBlocksHere : std::numeric_limits<std::int64_t>::max()));
  TWIN_CHECK(chain.plan_beside());
  return chain.finish();
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
