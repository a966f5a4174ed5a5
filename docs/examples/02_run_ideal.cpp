// Run a program on the ideal machine, which stands where the set point is: what remains of the
// contour error is the planner's own.
#include <cstdio>
#include <twin/machines.hpp>
#include <twin/run.hpp>

int main() {
  const twin::Program program = twin::Program::from_text("G21 G90\nG2 X20 Y0 I10 J0 F1500\nM30\n");
  const auto machine = twin::make_ideal();
  twin::MemoryTrace trace;  // one row a period, in memory
  const twin::Run run = twin::run(program, twin::Settings(), *machine, {.sinks = {&trace}});
  if (run.failure) {
    std::printf("failed: %s\n", to_string(*run.failure).c_str());
    return 1;
  }
  const auto x = trace["x_cmd_mm"];
  const auto y = trace["y_cmd_mm"];
  std::printf("%zu rows, from (%.3f, %.3f) to (%.3f, %.3f) mm\n", trace.size(), x.front(),
              y.front(), x.back(), y.back());
  std::printf("largest contour error %.3f um\n", run.summary.number("contour_error_um.max"));
}
