#include "pictures/plot/timing_script.hpp"

#include <fmt/format.h>

namespace twin::pictures {

Script timing_script(const std::string& title, double period) {
  std::string settings = title_line(title) +
                         "set logscale xy\n"
                         "set xlabel 'time [µs]'\n"
                         "set ylabel 'periods'\n"
                         "set yrange [0.8:*]\n"
                         "set format x '%g'\n"
                         "set format y '%g'\n"
                         "count(name) = column(name) > 0 ? column(name) : NaN\n";
  if (period > 0.0) {
    settings += fmt::format(
        "set xrange [0.1<*:{0:g}<*]\n"
        "set arrow 1 from first {1:g}, graph 0 to first {1:g}, graph 1 nohead linecolor rgb "
        "'#404040' dashtype 2\n"
        "set label 2 'period' at first {1:g}, graph 0.97 right offset -0.5, 0\n",
        period * 2e6, period * 1e6);
  }
  return page("timing", settings,
              "  plot 'timing.csv' using 'time_us':(count('wake_up')) with linespoints linestyle 1 "
              "pointtype 7 pointsize 0.5 title 'wake-up', \\\n"
              "    '' using 'time_us':(count('compute')) with linespoints linestyle 3 pointtype 7 "
              "pointsize 0.5 title 'computation', \\\n"
              "    '' using 'time_us':(count('total')) with linespoints linestyle 2 pointtype 7 "
              "pointsize 0.5 title 'deadline to output'\n");
}

}  // namespace twin::pictures
