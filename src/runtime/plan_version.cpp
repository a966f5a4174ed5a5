#include "runtime/plan_version.hpp"

#include <utility>

namespace twin::runtime {

PlanVersion::PlanVersion(const config::MachineFile& machine, const PlanStart& start,
                         Remembers remembers)
    : start_(start),
      remembers_(remembers),
      look_ahead_(
          machine.limits, machine.planning, machine.path, machine.period,
          [this](feedrate::PlannedSegment&& planned) { append(std::move(planned)); },
          {start.s, start.v}, start.percent / 100.0) {}

void PlanVersion::append(feedrate::PlannedSegment&& planned) {
  planned.index += start_.lead_in;
  planned.plan = start_.number;
  if (planned.index < start_.segment) {
    return;
  }
  for (const feedrate::Phase& phase : planned.phases) {
    time_ += phase.duration;
  }
  if (remembers_ == Remembers::kPhases) {
    phases_.push_back(
        {.index = planned.index, .length = planned.segment.length, .phases = planned.phases});
  }
  ready_.push_back(std::move(planned));
}

void PlanVersion::drop_before(std::int64_t segment) {
  while (!phases_.empty() && phases_.front().index < segment) {
    phases_.pop_front();
  }
}

}  // namespace twin::runtime
