#include "runtime/planning_loop.hpp"

#include <algorithm>
#include <optional>

#include "runtime/nap.hpp"

namespace twin::runtime {

Expected<void> PlanningLoop::run() {
  while (!queue_.is_stopped()) {
    TWIN_CHECK(serve());
    TWIN_CHECK(planner_.plan_ahead(1));
    if (planner_.waiting() == 0) {
      queue_.close(planner_.plan());
      nap();
    } else if (!queue_front()) {
      nap();
    }
  }
  return {};
}

/// Queues the next segment. @returns false if enough of them wait
bool PlanningLoop::queue_front() {
  if (planner_.front().index - link_.segment() > look_ahead_) {
    return false;
  }
  if (before_segment && !is_announced_) {
    before_segment(announced_++);
  }
  is_announced_ = true;
  const double reach = planner_.reach_of_front();
  if (!queue_.try_push(planner_.front(), planner_.plan(), reach)) {
    return false;
  }
  is_announced_ = false;
  planner_.pop_front();
  return true;
}

/// Answers the motion thread, if it has asked.
Expected<void> PlanningLoop::serve() {
  planner_.drop_before(link_.segment());
  if (link_.request() == nullptr) {
    return {};
  }
  const ReplanRequest request = *link_.request();
  TWIN_TRY(const ReplanOffer offer, planner_.offer(request));
  if (offer.kind == ReplanOffer::Kind::kPlan) {
    queue_.set_reach(offer.at.plan,
                     std::min(queue_.reach(planner_.plan()), planner_.start_of_offer()));
  }
  link_.offer(offer);
  std::optional<Verdict> verdict;
  while (!(verdict = link_.verdict()) && !queue_.is_stopped()) {
    nap();
  }
  planner_.conclude(offer, request, verdict.value_or(Verdict::kRejected));
  link_.close();
  return {};
}

}  // namespace twin::runtime
