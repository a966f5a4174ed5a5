// How far from the optimum is the plan? The bound is the time of the same path without jerk limit.
#include <cstdio>
#include <twin/plan.hpp>

int main() {
  const twin::Program program = twin::Program::from_file("square.nc");
  for (const double jerk : {20000.0, 50000.0, 200000.0}) {
    twin::Settings settings;
    settings.set("limits.jerk_mm_per_s3", jerk);
    const twin::Plan plan = twin::plan(program, settings);
    const double bound = plan.bound();
    std::printf("jerk %6.0f mm/s^3: %.3f s, bound %.3f s, ratio %.3f\n", jerk, plan.time(), bound,
                plan.time() / bound);
  }
}
