#include "runtime/run.hpp"

#include "library/inside.hpp"
#include "session/results.hpp"

namespace twin {
namespace {

static_assert(static_cast<int>(runtime::MotionState::kEnded) ==
              static_cast<int>(Panel::State::kEnded));

runtime::RunRequest request_of(const Program& program, const Settings& settings, Machine& machine,
                               const RunOptions& options) {
  runtime::RunRequest request;
  request.program = Inside::of(program).source;
  request.feedrate = Inside::of(program).feedrate;
  request.machine = Inside::of(settings);
  request.hal = &machine;
  request.directory = options.folder;
  request.sinks = options.sinks;
  request.is_wall_clock = options.is_wall_clock || machine.info().keeps_own_time;
  for (const OverrideChange& change : options.overrides) {
    request.overrides.push_back({change.time, change.percent});
  }
  if (options.panel != nullptr) {
    request.panel = &Inside::of(*options.panel).panel;
    request.stop = &Inside::of(*options.panel).stop;
  }
  request.progress = options.progress;
  return request;
}

}  // namespace

Panel::Panel() : data_(std::make_unique<Data>()) {}
Panel::~Panel() = default;
void Panel::set_override(double percent) noexcept { data_->panel.set_override(percent); }
void Panel::hold() noexcept { data_->panel.hold(true); }
void Panel::resume() noexcept { data_->panel.hold(false); }
void Panel::stop() noexcept { data_->stop = true; }

Panel::Display Panel::display() const noexcept {
  const runtime::OperatorPanel::Display shown = data_->panel.display();
  return {static_cast<State>(shown.state), shown.time, shown.percent, shown.feedrate, shown.line};
}

Run run(const Program& program, const Settings& settings, Machine& machine,
        const RunOptions& options) {
  const runtime::RunRequest request = request_of(program, settings, machine, options);
  const runtime::RunResult result = value_of(runtime::run_program(request));
  if (!options.folder.empty()) {
    check(session::write_summary(options.folder, result));
    if (!result.failure) {
      session::remove_stale_results(options.folder);
    }
  }
  return {Inside::summary(result.summary, request.machine.limits), result.failure};
}

}  // namespace twin
