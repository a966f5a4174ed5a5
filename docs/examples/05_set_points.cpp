// Set points for a loop of one's own: no machine, no file, one set point when it is asked for.
#include <cstdio>
#include <twin/interpolator.hpp>

int main() {
  const twin::Program program = twin::Program::from_text("G21 G90\nG1 X10 Y5 F1200\nM30\n");
  twin::Interpolator interpolator(program, twin::Settings());
  long count = 0;
  twin::SetPoint last;
  while (const auto point = interpolator.next()) {
    if (count % 100 == 0) {
      std::printf("%.3f s: x %7.4f y %7.4f mm, %6.3f mm/s\n", point->time, point->position[0],
                  point->position[1], point->feedrate);
    }
    last = *point;
    ++count;
  }
  std::printf("%ld set points, the last at (%.3f, %.3f) mm\n", count, last.position[0],
              last.position[1]);
}
