#include "runtime/plan_version.hpp"

#include <utility>

namespace twin::runtime {

PlanVersion::PlanVersion(const config::MachineFile& machine, const PlanStart& start, bool remembers)
    : start_(start),
      remembers_(remembers),
      look_ahead_(
          machine.limits, machine.planning, machine.path, machine.period,
          [this](feedrate::PlannedSegment&& planned) { take(std::move(planned)); },
          {start.s, start.v}, start.percent / 100.0) {}

void PlanVersion::take(feedrate::PlannedSegment&& planned) {
  planned.index += start_.lead_in;
  planned.plan = start_.number;
  if (planned.index < start_.segment) {
    return;
  }
  for (const feedrate::Phase& phase : planned.phases) {
    time_ += phase.duration;
  }
  if (remembers_) {
    phases_.push_back({planned.index, planned.segment.length, planned.phases});
  }
  ready_.push_back(std::move(planned));
}

void PlanVersion::drop_before(std::int64_t segment) {
  while (!phases_.empty() && phases_.front().index < segment) {
    phases_.pop_front();
  }
}

}  // namespace twin::runtime
