// Change the feed override and hold while the machine moves, here from a second thread.
#include <chrono>
#include <cstdio>
#include <thread>
#include <twin/machines.hpp>
#include <twin/run.hpp>

int main() {
  using namespace std::chrono_literals;
  const twin::Program program = twin::Program::from_text("G21 G90\nG1 X30 F1800\nM30\n");
  const auto machine = twin::make_ideal();
  twin::Panel panel;
  const std::jthread person([&panel] {
    while (panel.display().state == twin::Panel::State::kWaiting) {
      std::this_thread::sleep_for(1ms);
    }
    std::this_thread::sleep_for(200ms);
    panel.set_override(50.0);
    std::this_thread::sleep_for(200ms);
    panel.hold();
    std::this_thread::sleep_for(200ms);
    std::printf("in the hold: %s\n",
                panel.display().state == twin::Panel::State::kHolding ? "holding" : "not holding");
    panel.resume();
  });
  const twin::Run run =
      twin::run(program, twin::Settings(), *machine, {.is_wall_clock = true, .panel = &panel});
  std::printf("%s\n", run.failure ? to_string(*run.failure).c_str() : "reached the end");
  std::printf("planned for %.2f s, took %s\n", run.summary.number("planned_time_s"),
              run.summary.number("machining_time_s") > run.summary.number("planned_time_s") + 0.2
                  ? "longer, for the override and the hold"
                  : "no longer");
}
