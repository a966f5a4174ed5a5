#include "pictures/plot/circular_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/units.hpp"
#include "pictures/plot/gnuplot.hpp"
#include "results/trace/decimator.hpp"

namespace twin::pictures {
namespace {

namespace fs = std::filesystem;

constexpr double kMostDivisions = 4.0;  // that the largest error spans
constexpr std::size_t kMostTurnRows = 8000;
constexpr std::array<std::string_view, 2> kSenses{"ccw", "cw"};

/// Largest radial error of both paths [mm].
double largest_error(const CircularFigureInput& input) {
  double largest = 0.0;
  for (const std::span<const Vec2> path : input.path) {
    for (const Vec2& point : path) {
      largest = std::max(largest, std::abs(point.norm() - input.radius));
    }
  }
  return largest;
}

/// One path as angle and radial error, its first point once more at its end.
Expected<void> write_path(const fs::path& folder, std::string_view sense,
                          std::span<const Vec2> path, double radius) {
  results::Decimator decimator(2, {1}, kMostTurnRows);
  const auto push = [&](const Vec2& point) {
    const std::array<double, 2> row{units::deg_from_rad(std::atan2(point.y(), point.x())),
                                    units::um_from_mm(point.norm() - radius)};
    decimator.push(row);
  };
  for (const Vec2& point : path) {
    push(point);
  }
  if (!path.empty()) {
    push(path.front());
  }
  const results::Table table = decimator.finish();
  constexpr std::array<std::string_view, 2> columns{"angle_deg", "radial_error_um"};
  return write_table(folder, fmt::format("circular_test_{}", sense), columns, table);
}

/// Rings, spokes and their labels, in divisions; the nominal circle has the radius `base`.
constexpr std::string_view kGrid = R"(base = 7
rings = 4
unset border
unset tics
unset grid
set size ratio -1
set angles degrees
set parametric
set trange [0 : 360]
set samples 361
outer = base + rings
set xrange [-outer - 2.85 : outer + 2.85]
set yrange [-outer - 1.5 : outer + 1.5]
set lmargin at screen 0
set rmargin at screen 1
do for [a = 0 : 330 : 30] {
  set arrow from (base - rings) * cos(a), (base - rings) * sin(a) to outer * cos(a), outer * sin(a) \
    nohead back linecolor rgb '#D0D0D0' linewidth 1
  if (a % 180 != 0) {
    set label a == 90 ? '90° +Y' : sprintf('%d°', a) at (outer + 1.2) * cos(a), (outer + 0.7) * sin(a) center
  }
}
set label "+X\n0°" at outer + 0.3, 0 left
set label '180°' at -outer - 0.3, 0 right
set style textbox opaque noborder fillcolor rgb '#FFFFFF' margins 0.4, 0.3
do for [k = -4 : 4 : 2] {
  error_name = k == 0 ? '0' : k == 4 ? sprintf('%+g µm', k * division) : sprintf('%+g', k * division)
  set label error_name at (base + k) * cos(45), (base + k) * sin(45) center boxed front
}
)";

constexpr std::string_view kDrawing =
    R"(  plot for [k = -rings : rings] (base + k) * cos(t), (base + k) * sin(t) with lines \
      linecolor rgb '#D0D0D0' linewidth 1, \
    'circular_test_ccw.csv' using (x($1, $2)):(y($1, $2)) with lines \
      linecolor rgb '#0072B2' linewidth 1.1, \
    'circular_test_cw.csv' using (x($1, $2)):(y($1, $2)) with lines \
      linecolor rgb '#D55E00' linewidth 1.1, \
    base * cos(t), base * sin(t) with lines linecolor rgb '#000000' linewidth 1.1
)";

/// The page is made for a column of 8 cm: letters of 1/40 of its width are 2 mm high.
Script circular_script(const CircularFigureInput& input, double division) {
  std::string text = fmt::format(
      "# Draws circular_test.png and circular_test.svg from the data beside it: gnuplot "
      "circular_test.gp\n"
      "# circular_test.pdf, one column of a paper wide: gnuplot -e paper=1 circular_test.gp\n"
      "if (!exists('paper')) {{ paper = 0 }}\n"
      "set datafile separator ','\n"
      "set encoding utf8\n"
      "division = {:g}  # um of radial error\n",
      units::um_from_mm(division));
  text += kGrid;
  text += fmt::format(
      "x(angle, error) = (base + error / division) * cos(angle)\n"
      "y(angle, error) = (base + error / division) * sin(angle)\n"
      "set label {} at screen 0.5, screen 0.965 center noenhanced\n"
      "set label {} at screen 0.5, screen 0.92 center noenhanced\n"
      "set label '1 division = {:g} µm' at screen 0.5, screen 0.875 center\n"
      "set tmargin at screen 0.85\n"
      "set bmargin at screen 0.065\n"
      "unset key\n"
      "set label '— counter-clockwise' at screen 0.05, screen 0.035 left textcolor rgb '#0072B2'\n"
      "set label '— clockwise' at screen 0.49, screen 0.035 left textcolor rgb '#D55E00'\n"
      "set label '— nominal' at screen 0.76, screen 0.035 left\n",
      quoted(input.title), quoted(input.subtitle), units::um_from_mm(division));
  text +=
      "has_cairo = strstrt(GPVAL_TERMINALS, 'pngcairo') > 0\n"
      "do for [kind in paper ? 'pdf' : 'png svg'] {\n"
      "  if (kind eq 'pdf') {\n"
      "    set terminal pdfcairo size 8cm,9.2cm font 'DejaVu Sans,6' fontscale 1 linewidth 0.6\n"
      "  } else { if (kind eq 'svg') {\n"
      "    set terminal svg size 600,690 font 'DejaVu Sans,19' background '#FFFFFF'\n"
      "  } else { if (has_cairo) {\n"
      "    set terminal pngcairo size 1200,1380 font 'DejaVu Sans,31' linewidth 2\n"
      "  } else {\n"
      "    set terminal png truecolor size 1200,1380 font 'DejaVu Sans,31' linewidth 2\n"
      "  } } }\n"
      "  set output 'circular_test.'.kind\n";
  text += kDrawing;
  text += "  unset output\n}\n";
  return {"circular_test", text};
}

}  // namespace

double radial_division(double largest_error) {
  constexpr double least = 1e-6;  // [mm]
  const double wanted = std::max(largest_error / kMostDivisions, least);
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (wanted <= digit * decade * (1.0 + 1e-9)) {
      return digit * decade;
    }
  }
  return 10.0 * decade;
}

Expected<std::vector<fs::path>> write_circular_figure(const CircularFigureInput& input) {
  const fs::path folder = input.directory / "plots";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return file_error(folder, "create", error.value());
  }
  for (std::size_t i = 0; i < input.path.size(); ++i) {
    TWIN_CHECK(write_path(folder, kSenses[i], input.path[i], input.radius));
  }
  const std::array scripts{circular_script(input, radial_division(largest_error(input)))};
  return draw(folder, scripts, input.paper);
}

}  // namespace twin::pictures
