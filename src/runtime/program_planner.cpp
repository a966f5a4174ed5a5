#include "runtime/program_planner.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "feedrate/planner.hpp"

namespace twin::runtime {
namespace {

constexpr double kLeadInPeriods = 8.0;  // at the largest feedrate, for corners just behind
constexpr int kTries = 20;              // places looked at for one request
constexpr double kStride = 0.005;       // between them [s]

/// Acceleration that is none where a plan takes over, which loses it within a period: as a share of A, and of what the
/// jerk changes in a period. With a low jerk a share of A may be all that a ramp ever has.
constexpr double kLevel = 1e-6;
constexpr double kLevelOfJerk = 1e-4;

}  // namespace

ProgramPlanner::ProgramPlanner(BlockSource blocks, const config::MachineFile& machine,
                               Replans replans, double percent)
    : blocks_(std::move(blocks)),
      machine_(machine),
      replans_(replans),
      builder_(
          feedrate::make_planner(machine.limits, machine.planning, machine.path, machine.period)
              ->make_builder([this](path::Segment&& segment) { append(std::move(segment)); })),
      path_(kLeadInPeriods * machine.limits.feedrate * machine.period),
      active_(std::make_unique<PlanVersion>(
          machine, PlanStart{.percent = percent},
          replans == Replans::kOnRequest ? Remembers::kPhases : Remembers::kNothing)) {}

void ProgramPlanner::preload(std::deque<feedrate::PlannedSegment>&& segments,
                             const PlanFigures& figures) {
  older_ = std::move(segments);
  figures_ = figures;
  is_all_read_ = true;
}

/// Whether so many segments wait, or segments of so much length.
bool ProgramPlanner::is_ahead(std::size_t segments, double length) noexcept {
  double ahead = 0.0;
  for (const auto* waiting_segments : {&older_, &active_->ready()}) {
    for (const feedrate::PlannedSegment& planned : *waiting_segments) {
      ahead += planned.segment.length;
      if (ahead >= length) {
        return true;
      }
    }
  }
  return waiting() >= segments;
}

Expected<void> ProgramPlanner::plan_ahead(std::size_t segments, double length) {
  while (!is_all_read_ && !is_ahead(segments, length)) {
    TWIN_CHECK(read_on());
  }
  return {};
}

void ProgramPlanner::pop_front() {
  std::deque<feedrate::PlannedSegment>& from = older_.empty() ? active_->ready() : older_;
  from.pop_front();
}

double ProgramPlanner::reach_of_front() noexcept {
  if (!replans()) {
    return 0.0;
  }
  const double end = path_.end_of(front().index);
  return older_.empty() ? end : std::min(end, start_of_active_);
}

PlanFigures ProgramPlanner::figures() const {
  PlanFigures figures = figures_;
  figures.time += active_->time();
  figures.fallbacks += active_->fallbacks();
  return figures;
}

/// Reads one block of the program, or its end.
Expected<void> ProgramPlanner::read_on() {
  TWIN_TRY(const std::optional<gcode::Block> block, blocks_());
  if (block) {
    figures_.blocks += block->motion == gcode::Motion::kDwell ? 0 : 1;
    builder_->push(*block);
    return {};
  }
  is_all_read_ = true;
  builder_->finish();
  active_->finish();
  if (candidate_) {
    candidate_->finish();
  }
  return {};
}

/// Appends a segment to the path and to its plans.
void ProgramPlanner::append(path::Segment&& segment) {
  count(segment, machine_.path.short_block_length, figures_);
  if (replans()) {
    path_.add(segment);
  }
  if (candidate_) {
    candidate_->push(path::Segment(segment));
  }
  active_->push(std::move(segment));
}

/// Whether the path has a segment of this number; reads on until that is known.
Expected<bool> ProgramPlanner::has_segment(std::int64_t index) {
  while (path_.end() <= index && !is_all_read_) {
    TWIN_CHECK(read_on());
  }
  return index < path_.end();
}

/// A start in a segment that is there.
ProgramPlanner::Start ProgramPlanner::start_at(std::int64_t segment, double s, double v,
                                               double percent) const {
  Start start;
  start.plan.number = active_->number() + 1;
  start.plan.lead_in = path_.lead_in(segment);
  start.plan.segment = segment;
  start.plan.s = path_.begin_of(segment) - path_.begin_of(start.plan.lead_in) + s;
  start.plan.v = v;
  start.plan.percent = percent;
  start.at.plan = start.plan.number;
  start.distance = path_.begin_of(segment) + s;
  return start;
}

/// Where a plan starts from rest; nothing at the path's end.
Expected<std::optional<ProgramPlanner::Start>> ProgramPlanner::start_at_rest(
    const ReplanRequest& request) {
  auto [segment, phase, time, s] = request.from;
  if (s > path_[segment].length - kSegmentEnd && path_[segment].length > 0.0) {
    ++segment;
    s = 0.0;
  }
  TWIN_TRY(const bool is_there, has_segment(segment));
  return is_there ? std::optional(start_at(segment, s, 0.0, request.percent)) : std::nullopt;
}

/// The first place ahead where a plan may start; nothing where the path ends before.
Expected<std::optional<ProgramPlanner::Start>> ProgramPlanner::start_ahead(
    const ReplanRequest& request) {
  const Limits& limits = machine_.limits;
  const double tolerance =
      std::min(kLevel * limits.acceleration, kLevelOfJerk * limits.jerk * machine_.period);
  for (;;) {
    const auto place =
        find_switch_place(active_->phases(), request.from, request.margin, tolerance);
    if (place) {
      const std::int64_t segment = place->segment + (place->is_at_end ? 1 : 0);
      TWIN_TRY(const bool is_there, has_segment(segment));
      if (!is_there) {
        return std::nullopt;
      }
      Start start = start_at(segment, place->is_at_end ? 0.0 : place->s, place->v, request.percent);
      start.at = {start.plan.number, place->segment, place->phase, place->time, start.distance};
      start.after = place->after;
      return start;
    }
    if (is_all_read_) {
      return std::nullopt;
    }
    TWIN_CHECK(read_on());
  }
}

/// Plans the path from a start on. @returns whether that keeps every limit
Expected<bool> ProgramPlanner::make_candidate(const Start& start) {
  candidate_ = std::make_unique<PlanVersion>(machine_, start.plan, Remembers::kPhases);
  for (std::int64_t i = start.plan.lead_in; i < path_.end(); ++i) {
    candidate_->push(path::Segment(path_[i]));
  }
  if (is_all_read_) {
    candidate_->finish();
  }
  while (candidate_->ready().empty() && !is_all_read_) {
    TWIN_CHECK(read_on());
  }
  start_of_candidate_ = start.distance;
  return start.plan.v == 0.0 || candidate_->fallbacks() == 0;
}

Expected<ReplanOffer> ProgramPlanner::offer(ReplanRequest request) {
  for (int i = 0; i < kTries; ++i) {
    TWIN_TRY(const std::optional<Start> start,
             request.is_at_rest ? start_at_rest(request) : start_ahead(request));
    if (!start) {
      return ReplanOffer{.kind = ReplanOffer::Kind::kPathEnd, .at = {}};
    }
    TWIN_TRY(const bool is_within_limits, make_candidate(*start));
    if (is_within_limits) {
      return ReplanOffer{
          .kind = ReplanOffer::Kind::kPlan, .at = start->at, .distance = start->distance};
    }
    request.margin = start->after + kStride;
  }
  return ReplanOffer{.kind = ReplanOffer::Kind::kOnlyRest, .at = {}};
}

void ProgramPlanner::drop_before(std::int64_t segment) {
  path_.drop_before(segment);
  active_->drop_before(segment);
}

void ProgramPlanner::conclude(const ReplanOffer& offer, const ReplanRequest& request,
                              Verdict verdict) {
  if (verdict == Verdict::kAccepted && offer.kind == ReplanOffer::Kind::kPlan) {
    put_into_force(offer.at, request.is_at_rest);
  }
  candidate_.reset();
}

/// Makes the candidate the plan in force, after the rest of the present one up to the switch.
void ProgramPlanner::put_into_force(const motion::PlanSwitch& at, bool is_at_rest) {
  auto& ready = active_->ready();
  if (is_at_rest) {
    older_.clear();
    ready.clear();
  }
  while (!ready.empty() && ready.back().index > at.segment) {
    ready.pop_back();
  }
  std::move(ready.begin(), ready.end(), std::back_inserter(older_));
  figures_.fallbacks += active_->fallbacks();
  active_ = std::move(candidate_);
  start_of_active_ = start_of_candidate_;
}

}  // namespace twin::runtime
