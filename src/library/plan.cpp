#include "core/path_settings.hpp"
#include "library/inside.hpp"
#include "runtime/program_bound.hpp"
#include "runtime/program_check.hpp"
#include "runtime/run_options.hpp"

namespace twin {

Plan plan(const Program& program, const Settings& settings, const std::atomic<bool>* stop) {
  const auto& data = Inside::of(program);
  const config::MachineFile& machine = Inside::of(settings);
  const auto estimate = value_of(runtime::estimate_program(
      data.source, runtime::reader_options(machine, data.feedrate), machine, stop));
  return Inside::plan(program, settings, estimate.plan);
}

Plan Inside::plan(const Program& program, const Settings& settings,
                  const runtime::PlanFigures& figures) {
  const config::MachineFile& machine = of(settings);
  Plan plan(program, settings);
  plan.time_ = figures.time;
  plan.path_length_ = figures.path_length;
  plan.blocks_ = figures.blocks;
  plan.curves_ = figures.curves;
  plan.lines_ = figures.lines;
  plan.arcs_ = figures.arcs;
  if (machine.path.planner == Planner::kCertified) {
    plan.certified_deviation_ = figures.deviation;
  }
  return plan;
}

double Plan::bound(const std::atomic<bool>* stop) const {
  const auto& data = Inside::of(program_);
  return value_of(runtime::time_bound(data.source, Inside::of(settings_), data.feedrate, stop));
}

}  // namespace twin
