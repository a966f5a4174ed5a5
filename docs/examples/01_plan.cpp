// Plan a program: the time it will take, what it becomes, and how far it is from the drawing.
#include <cstdio>
#include <twin/plan.hpp>

int main() {
  const twin::Program program = twin::Program::from_file("circle.nc");
  const twin::Settings settings;  // those of mjcf/xy_table.toml
  const twin::Plan plan = twin::plan(program, settings);

  std::printf("%s: %lld blocks become %lld curves, %lld lines, %lld arcs\n", program.name().c_str(),
              static_cast<long long>(plan.blocks()), static_cast<long long>(plan.curves()),
              static_cast<long long>(plan.lines()), static_cast<long long>(plan.arcs()));
  std::printf("path %.3f mm in %.3f s\n", plan.path_length(), plan.time());
  if (const auto deviation = plan.certified_deviation()) {
    std::printf("never further than %.2f um from the program\n", *deviation * 1e3);
  }
}
