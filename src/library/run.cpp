#include "twin/run.hpp"

#include "library/inside.hpp"
#include "session/session.hpp"

namespace twin {
namespace {

static_assert(static_cast<int>(runtime::MotionState::kEnded) ==
              static_cast<int>(Panel::State::kEnded));

session::Request request_of(const Program& program, const Settings& settings, Machine& machine,
                            const RunOptions& options) {
  session::Request request;
  request.program = Inside::of(program).source;
  request.feedrate = Inside::of(program).feedrate;
  request.machine = Inside::of(settings);
  request.hal = &machine;
  request.folder = options.folder;
  request.files = options.folder.empty() ? session::Files::kNone : session::Files::kWritten;
  request.sinks = options.sinks;
  request.pace = options.is_wall_clock ? session::Pace::kWallClock : session::Pace::kOwn;
  request.servo = options.servo;
  for (const OverrideChange& change : options.overrides) {
    request.overrides.push_back({change.time, change.percent});
  }
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
  session::Session session =
      value_of(session::Session::open(request_of(program, settings, machine, options)));
  session::Attendance attendance;
  attendance.stop = options.stop;
  if (options.panel != nullptr) {
    attendance.panel = &Inside::of(*options.panel).panel;
    attendance.stop = &Inside::of(*options.panel).stop;
  }
  attendance.progress = options.progress;
  const runtime::RunResult result = value_of(session.run(attendance));
  return {Inside::summary(result.summary, session.machine().limits), result.failure};
}

}  // namespace twin
