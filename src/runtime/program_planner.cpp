#include "runtime/program_planner.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "feedrate/planner.hpp"

namespace twin::runtime {
namespace {

constexpr double kLeadInPeriods = 8.0;  // at the largest feedrate, for corners just behind
constexpr double kLevel = 1e-6;         // share of A_max that is no acceleration
constexpr int kTries = 20;              // places looked at for one request
constexpr double kStride = 0.005;       // between them [s]

void nap(int microseconds) { std::this_thread::sleep_for(std::chrono::microseconds(microseconds)); }

}  // namespace

ProgramPlanner::ProgramPlanner(gcode::Reader& reader, const config::MachineFile& machine,
                               SegmentQueue& queue, ReplanLink* link, double percent)
    : reader_(reader),
      machine_(machine),
      queue_(queue),
      link_(link),
      builder_(
          feedrate::make_planner(machine.limits, machine.planning, machine.path, machine.period)
              ->make_builder([this](path::Segment&& segment) { take(std::move(segment)); })),
      path_(kLeadInPeriods * machine.limits.feedrate * machine.period),
      active_(
          std::make_unique<PlanVersion>(machine, PlanStart{.percent = percent}, link != nullptr)) {}

Expected<PlanFigures> ProgramPlanner::run() {
  while (!queue_.is_stopped()) {
    if (link_ != nullptr) {
      if (auto served = serve(); !served) {
        return tl::unexpected(served.error());
      }
    }
    if (!older_.empty() || !active_->ready().empty()) {
      if (!hand_on()) {
        nap(50);
      }
    } else if (!is_all_read_) {
      if (auto read = read_on(); !read) {
        return tl::unexpected(read.error());
      }
    } else {
      queue_.close(active_->number());
      if (link_ == nullptr) {
        break;
      }
      nap(100);
    }
  }
  figures_.time += active_->time();
  figures_.fallbacks += active_->fallbacks();
  return figures_;
}

/// Hands the next segment on. @returns false if enough of them wait
bool ProgramPlanner::hand_on() {
  const bool is_older = !older_.empty();
  std::deque<feedrate::PlannedSegment>& from = is_older ? older_ : active_->ready();
  if (link_ != nullptr && from.front().index - link_->segment() > machine_.path.look_ahead) {
    return false;
  }
  if (before_segment && !is_announced_) {
    before_segment(handed_on_++);
  }
  is_announced_ = true;
  double reach = 0.0;
  if (link_ != nullptr) {
    const double end = path_.end_of(from.front().index);
    reach = is_older ? std::min(end, start_of_active_) : end;
  }
  if (!queue_.try_push(from.front(), active_->number(), reach)) {
    return false;
  }
  is_announced_ = false;
  from.pop_front();
  return true;
}

/// Takes one block of the program, or its end.
Expected<void> ProgramPlanner::read_on() {
  auto block = reader_.next();
  if (!block) {
    return tl::unexpected(block.error());
  }
  if (block->has_value()) {
    figures_.blocks += (*block)->motion == gcode::Motion::kDwell ? 0 : 1;
    builder_->push(**block);
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

void ProgramPlanner::take(path::Segment&& segment) {
  count(segment, machine_.path.short_block_length, figures_);
  if (link_ != nullptr) {
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
    if (auto read = read_on(); !read) {
      return tl::unexpected(read.error());
    }
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
  const auto is_there = has_segment(segment);
  if (!is_there) {
    return tl::unexpected(is_there.error());
  }
  return *is_there ? std::optional(start_at(segment, s, 0.0, request.percent)) : std::nullopt;
}

/// The first place ahead where a plan may start; nothing where the path ends before.
Expected<std::optional<ProgramPlanner::Start>> ProgramPlanner::start_ahead(
    const ReplanRequest& request) {
  const double tolerance = kLevel * machine_.limits.acceleration;
  for (;;) {
    const auto place =
        find_switch_place(active_->phases(), request.from, request.margin, tolerance);
    if (place) {
      const std::int64_t segment = place->segment + (place->is_at_end ? 1 : 0);
      const auto is_there = has_segment(segment);
      if (!is_there) {
        return tl::unexpected(is_there.error());
      }
      if (!*is_there) {
        return std::nullopt;
      }
      Start start = start_at(segment, place->is_at_end ? 0.0 : place->s, place->v, request.percent);
      start.at = {start.plan.number, place->segment, place->phase, place->time};
      start.after = place->after;
      return start;
    }
    if (is_all_read_) {
      return std::nullopt;
    }
    if (auto read = read_on(); !read) {
      return tl::unexpected(read.error());
    }
  }
}

/// Plans the path from a start on. @returns whether that keeps every limit
Expected<bool> ProgramPlanner::make_candidate(const Start& start) {
  candidate_ = std::make_unique<PlanVersion>(machine_, start.plan, true);
  for (std::int64_t i = start.plan.lead_in; i < path_.end(); ++i) {
    candidate_->push(path::Segment(path_[i]));
  }
  if (is_all_read_) {
    candidate_->finish();
  }
  while (candidate_->ready().empty() && !is_all_read_) {
    if (auto read = read_on(); !read) {
      return tl::unexpected(read.error());
    }
  }
  start_of_candidate_ = start.distance;
  return start.plan.v == 0.0 || candidate_->fallbacks() == 0;
}

Expected<ReplanOffer> ProgramPlanner::replan(ReplanRequest request) {
  for (int i = 0; i < kTries; ++i) {
    const auto start = request.is_at_rest ? start_at_rest(request) : start_ahead(request);
    if (!start) {
      return tl::unexpected(start.error());
    }
    if (!*start) {
      return ReplanOffer{ReplanOffer::Kind::kPathEnd, {}, 0.0};
    }
    const auto is_made = make_candidate(**start);
    if (!is_made) {
      return tl::unexpected(is_made.error());
    }
    if (*is_made) {
      return ReplanOffer{ReplanOffer::Kind::kPlan, (*start)->at, (*start)->distance};
    }
    request.margin = (*start)->after + kStride;
  }
  return ReplanOffer{ReplanOffer::Kind::kOnlyRest, {}, 0.0};
}

/// Answers the motion thread, if it has asked.
Expected<void> ProgramPlanner::serve() {
  path_.drop_before(link_->segment());
  active_->drop_before(link_->segment());
  const ReplanRequest* request = link_->request();
  if (request == nullptr) {
    return {};
  }
  const bool is_at_rest = request->is_at_rest;
  const auto offer = replan(*request);
  if (!offer) {
    return tl::unexpected(offer.error());
  }
  if (offer->kind == ReplanOffer::Kind::kPlan) {
    queue_.set_reach(offer->at.plan,
                     std::min(queue_.reach(active_->number()), start_of_candidate_));
  }
  link_->offer(*offer);
  std::optional<bool> verdict;
  while (!(verdict = link_->verdict()) && !queue_.is_stopped()) {
    nap(20);
  }
  if (verdict == true && offer->kind == ReplanOffer::Kind::kPlan) {
    put_into_force(offer->at, is_at_rest);
  }
  candidate_.reset();
  link_->close();
  return {};
}

/// The candidate is the plan to hand on, after the rest of the present one up to the switch.
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
