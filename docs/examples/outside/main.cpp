#include <cstdio>
#include <twin/twin.hpp>

int main() {
  const twin::Program program = twin::Program::from_file("circle.nc");
  const twin::Settings settings;
  const auto table = twin::make_table(settings);
  const twin::Run run = twin::run(program, settings, *table);
  std::printf("%.3f s, contour error %.1f um\n", run.summary.number("machining_time_s"),
              run.summary.number("contour_error_um.max"));
}
