#include "pictures/plot/scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/trace/columns.hpp"

namespace twin::pictures {
namespace {

/// Colours that colour-blind readers can tell apart (Okabe and Ito).
constexpr std::string_view kBlue = "#0072B2";
constexpr std::string_view kVermilion = "#D55E00";
constexpr std::string_view kGreen = "#009E73";
constexpr std::string_view kGrey = "#B0B0B0";

constexpr int kWidth = 1200;  // of the PNG [pixels]; the SVG is smaller by kSvgScale
constexpr int kHeight = 900;
constexpr double kSvgScale = 2.0 / 3.0;
constexpr double kColumn = 8.6;  // width of the PDF, of one column of a paper [cm]

/// Height of a picture [pixels] at which a path of this shape leaves no empty strip.
/// @param axes  width of the plot [pixels]
int path_height(const Vec2& extent, double axes = 1000.0) {
  constexpr double border = 250.0;  // title, legend and labels [pixels]
  constexpr double least = 600.0;
  const double wanted = border + axes * 1.12 * extent.y() / std::max(extent.x(), 1e-6);
  return static_cast<int>(std::clamp(wanted, least, static_cast<double>(kHeight)));
}

/// Pixels counted from the upper edge, as a part of the picture's height; letters of a paper's figure
/// are larger beside the picture, and so is what stands between them.
std::string from_top(int pixels, int height, int on_paper) {
  return fmt::format("paper ? {:.4f} : {:.4f}", 1.0 - static_cast<double>(on_paper) / height,
                     1.0 - static_cast<double>(pixels) / height);
}

/// A whole script: the same page for both formats, then what the figure adds.
Script script(const std::string& name, const std::string& settings, const std::string& drawing,
              int height = kHeight) {
  std::string text = fmt::format(
      "# Draws {0}.png and {0}.svg from the data beside it: gnuplot {0}.gp\n"
      "# {0}.pdf, one column of a paper wide: gnuplot -e paper=1 {0}.gp\n"
      "if (!exists('paper')) {{ paper = 0 }}\n"
      "set datafile separator ','\n"
      "set encoding utf8\n"
      "set border 3 linecolor rgb '#404040'\n"
      "set tics nomirror out\n"
      "set autoscale xfix\n"
      "set grid linecolor rgb '#E0E0E0' linetype 1 linewidth 0.5\n"
      "set style line 1 linecolor rgb '{1}' linewidth 1.5\n"
      "set style line 2 linecolor rgb '{2}' linewidth 1.5\n"
      "set style line 3 linecolor rgb '{3}' linewidth 1.5\n"
      "set style line 4 linecolor rgb '{4}' linewidth 3\n"
      "set style line 6 linecolor rgb '#E69F00' linewidth 1.2\n"
      "set style line 7 linecolor rgb '#9CC7E4' linewidth 0.7\n"
      "set style line 8 linecolor rgb '#202020' linewidth 1.8\n"
      "set style line 9 linecolor rgb '#D55E00' linewidth 0.8 dashtype 2\n"
      "set style line 5 linecolor rgb '{4}' linewidth 1 dashtype 3\n"
      "set key at screen 0.5, screen ({5}) center center horizontal Left reverse samplen 2 width "
      "2\n"
      "set tmargin at screen ({6})\n",
      name, kBlue, kVermilion, kGreen, kGrey, from_top(106, height, 52),
      from_top(142, height, 104));
  text += settings;
  text += fmt::format(
      "has_cairo = strstrt(GPVAL_TERMINALS, 'pngcairo') > 0\n"
      "do for [kind in paper ? 'pdf' : 'png svg'] {{\n"
      "  if (kind eq 'pdf') {{\n"
      "    set terminal pdfcairo size {5:.1f}cm,{6:.2f}cm font 'DejaVu Sans,5' fontscale 1 "
      "pointscale 0.4 linewidth 0.6\n"
      "  }} else {{ if (kind eq 'svg') {{\n"
      "    set terminal svg size {1},{2} font 'DejaVu Sans,15' background '#FFFFFF'\n"
      "  }} else {{ if (has_cairo) {{\n"
      "    set terminal pngcairo size {3},{4} font 'DejaVu Sans,21' linewidth 1.6\n"
      "  }} else {{\n"
      "    set terminal png truecolor size {3},{4} font 'DejaVu Sans,21' linewidth 2\n"
      "  }} }} }}\n"
      "  set output '{0}.'.kind\n",
      name, std::lround(kWidth * kSvgScale), std::lround(height * kSvgScale), kWidth, height,
      kColumn, kColumn * height / kWidth);
  text += drawing;
  text += "  unset output\n}\n";
  return {name, text};
}

/// The title, and in smaller letters below it the settings of the run. A paper's figure has neither:
/// its own caption says so.
std::string set_title(const Heading& heading, int height = kHeight) {
  std::string text;
  const auto add = [&](int label, const std::string& line, int pixels, const char* look) {
    if (!line.empty()) {
      text += fmt::format(
          "if (!paper) {{ set label {} {} at screen 0.5, screen {:.4f} center {}noenhanced }}\n",
          label, quoted(line), 1.0 - static_cast<double>(pixels) / height, look);
    }
  };
  add(1, heading.title, 28, "");
  add(3, heading.settings, 60, "font ',13' textcolor rgb '#606060' ");
  return text;
}

/// Two panels under one title, over the same time, which is labelled once.
std::string two_panels(const std::string& upper, const std::string& lower) {
  return fmt::format(
      "  set multiplot layout 2,1 margins (paper ? 0.19 : 0.16), 0.97, (paper ? 0.17 : 0.13), "
      "(paper ? 0.96 : 0.89) spacing 0, 0.06\n"
      "  set format x ''\n"
      "  unset xlabel\n"
      "  {}\n"
      "  unset label\n"
      "  set format x '%h'\n"
      "  set xlabel 'time [s]'\n"
      "  {}\n"
      "  unset multiplot\n",
      upper, lower);
}

constexpr std::string_view kPathAxes =
    "set size ratio -1\n"
    "set autoscale fix\n"
    "set offsets graph 0.06, graph 0.06, graph 0.06, graph 0.06\n"
    "set xlabel 'x [mm]'\n"
    "set ylabel 'y [mm]'\n";

/// The programmed path below everything else, and the lifted moves, where there are any.
std::string background(const DataSummary& data) {
  std::string plots;
  if (data.has_programmed) {
    plots +=
        "'contour_programmed.csv' using 'x_mm':'y_mm' with lines linestyle 4 title 'programmed', "
        "\\\n    ";
  }
  if (data.has_pen_up) {
    plots +=
        "'contour.csv' using (up(column('x_cmd_mm'))):'y_cmd_mm' with lines linestyle 5 "
        "title 'pen up', \\\n    ";
  }
  return plots;
}

std::string pen_functions(const DataSummary& data) {
  return data.has_pen_up ? fmt::format(
                               "up(x) = column('pen_height_mm') > {0} ? x : NaN\n"
                               "down(x) = column('pen_height_mm') > {0} ? NaN : x\n",
                               results::kPenUp)
                         : "down(x) = x\n";
}

Script magnified_script(const Heading& heading, const DataSummary& data) {
  const int height = path_height(data.extent);
  const double n = magnification(data.extent.maxCoeff(), data.largest_error_um);
  std::string settings = set_title(heading, height) + std::string(kPathAxes) + pen_functions(data);
  settings += fmt::format("magnification = {}\n", n);
  settings +=
      "moved(x, error) = x + magnification * error / 1000.0\n"
      "key = sprintf('measured, error × %g', magnification)\n";
  const std::string drawing =
      "  plot 'contour_magnified.csv' using (down(moved(column('x_cmd_mm'), "
      "column('x_error_um')))):"
      "(moved(column('y_cmd_mm'), column('y_error_um'))) with lines linestyle 2 linewidth 0.6 "
      "title key, \\\n"
      "    '' using (down(column('x_cmd_mm'))):'y_cmd_mm' with lines linestyle 1 title 'command'\n";
  return script("contour_magnified", settings, drawing, height);
}

Script feedrate_script(const Heading& heading, const DataSummary& data) {
  const std::string settings = set_title(heading) +
                               "set xlabel 'time [s]'\n"
                               "set ylabel 'feedrate [mm/s]'\n"
                               "set yrange [0:*]\n"
                               "set offsets 0, 0, graph 0.04, 0\n";
  std::string drawing = "  plot ";
  if (data.has_limit) {
    drawing +=
        "'feedrate_limit.csv' using 't_s':'feedrate_limit_mm_per_s' with lines linestyle 6 "
        "title 'limit', \\\n    ";
  }
  drawing +=
      "'feedrate.csv' using 't_s':'feedrate_mm_per_s' with lines linestyle 1 title "
      "'feedrate'\n";
  return script("feedrate", settings, drawing);
}

/// A limit either way as thin lines; empty where it is not known.
std::string limit_lines(double limit) {
  return limit > 0.0
             ? fmt::format(", {0:g} with lines linestyle 9, -{0:g} with lines linestyle 9", limit)
             : std::string();
}

Script acceleration_script(const Heading& heading, const DataSummary& data) {
  const std::string settings = set_title(heading) + "unset key\nunset tmargin\n";
  return script("acceleration_jerk", settings,
                two_panels("set ylabel \"tangential\\nacceleration [mm/s²]\"\n"
                           "  plot 'acceleration_jerk.csv' using 't_s':'acceleration_mm_per_s2' "
                           "with lines linestyle 1 linewidth 1" +
                               limit_lines(data.acceleration_limit),
                           "set ylabel \"tangential\\njerk [10³ mm/s³]\"\n"
                           "  plot 'acceleration_jerk.csv' using 't_s':(column('jerk_mm_per_s3') / "
                           "1000) with lines linestyle 3 linewidth 1" +
                               limit_lines(data.jerk_limit / 1000.0)));
}

Script contour_error_script(const Heading& heading) {
  const std::string settings = set_title(heading) +
                               "set xlabel 'time [s]'\n"
                               "set ylabel 'contour error [µm]'\n"
                               "set yrange [0:*]\n"
                               "set offsets 0, 0, graph 0.04, 0\n";
  return script("contour_error", settings,
                "  plot 'contour_error.csv' using 't_s':'contour_error_um' with lines linestyle 7 "
                "title 'contour error', \\\n"
                "    '' using 't_s':'contour_error_rms_um' with lines linestyle 8 title "
                "'RMS of the last 0.1 s'\n");
}

Script tracking_script(const Heading& heading) {
  const std::string settings = set_title(heading) + "unset key\nunset tmargin\n";
  return script("tracking_errors", settings,
                two_panels("set ylabel \"tracking error\\nof x [µm]\"\n"
                           "  plot 'tracking_errors.csv' using 't_s':'x_tracking_error_um' with "
                           "lines linestyle 1 linewidth 1",
                           "set ylabel \"tracking error\\nof y [µm]\"\n"
                           "  plot 'tracking_errors.csv' using 't_s':'y_tracking_error_um' with "
                           "lines linestyle 2 linewidth 1"));
}

/// Viridis, whose light end is left out: the paper is white.
constexpr std::string_view kErrorColours =
    "set palette defined (0 '#440154', 1 '#472C7A', 2 '#3B518B', 3 '#2C718E', 4 '#21908D', "
    "5 '#27AD81', 6 '#5CC863', 7 '#AADC32')\n"
    "set cbrange [0:*]\n"
    "set cblabel 'contour error, RMS [µm]'\n"
    "set colorbox noborder\n";

/// A ring about the largest contour error, whose value is in the key.
std::string worst_mark(const DataSummary& data) {
  return data.worst_um > 0.0
             ? fmt::format(
                   "set label 2 '' at first {:.6f}, first {:.6f} point pointtype 6 pointsize 2.2 "
                   "linewidth 2 linecolor rgb '{}' front\n",
                   data.worst_at.x(), data.worst_at.y(), kVermilion)
             : std::string();
}

std::string worst_key(const DataSummary& data) {
  return data.worst_um > 0.0
             ? fmt::format(
                   ", \\\n    NaN with points pointtype 6 pointsize 2.2 linewidth 2 linecolor rgb "
                   "'{}' title 'largest {:.1f} µm'",
                   kVermilion, data.worst_um)
             : std::string();
}

Script contour_script(const Heading& heading, const DataSummary& data, bool plan_only) {
  constexpr double kBesideColours = 845.0;  // width of the plot beside the colour box [pixels]
  const int height =
      plan_only ? path_height(data.extent) : path_height(data.extent, kBesideColours);
  std::string settings = set_title(heading, height) + std::string(kPathAxes) + pen_functions(data);
  std::string drawing = "  plot " + background(data) +
                        "'contour.csv' using (down(column('x_cmd_mm'))):'y_cmd_mm' with lines "
                        "linestyle 1 " +
                        (plan_only ? "title 'command'" : "notitle");
  if (!plan_only) {
    settings += std::string(kErrorColours) + worst_mark(data);
    drawing +=
        ", \\\n    '' using (down(column('x_enc_mm'))):'y_enc_mm':'contour_error_rms_um' with "
        "lines "
        "linewidth 3 palette title 'measured'" +
        worst_key(data);
  }
  return script("contour", settings, drawing + "\n", height);
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "'";
  char before = '\0';
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 32) {
      result += ' ';
    } else if (c != '\'') {
      result += c;
    } else {
      // Gnuplot does not read two doubled quotes in a row, so the second one is joined to the first.
      result += before == '\'' ? R"('."'".')" : "''";
    }
    before = c;
  }
  return result + "'";
}

double magnification(double extent, double largest_error_um) {
  constexpr double part = 0.05;  // of the picture
  if (!(largest_error_um > 0.0) || !(extent > 0.0)) {
    return 1.0;
  }
  const double wanted = part * extent / (largest_error_um / 1000.0);
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  const double digit = wanted / decade;
  return std::max(1.0, decade * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0));
}

std::vector<Script> figure_scripts(const Heading& heading, const DataSummary& data,
                                   bool plan_only) {
  std::vector<Script> scripts{contour_script(heading, data, plan_only),
                              feedrate_script(heading, data), acceleration_script(heading, data)};
  if (!plan_only) {
    scripts.push_back(magnified_script(heading, data));
    scripts.push_back(contour_error_script(heading));
    scripts.push_back(tracking_script(heading));
  }
  return scripts;
}

Script timing_script(const Heading& heading, double period) {
  std::string settings = set_title(heading) +
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
  return script(
      "timing", settings,
      "  plot 'timing.csv' using 'time_us':(count('wake_up')) with linespoints linestyle 1 "
      "pointtype 7 pointsize 0.5 title 'wake-up', \\\n"
      "    '' using 'time_us':(count('compute')) with linespoints linestyle 3 pointtype 7 "
      "pointsize 0.5 title 'computation', \\\n"
      "    '' using 'time_us':(count('total')) with linespoints linestyle 2 pointtype 7 "
      "pointsize 0.5 title 'deadline to output'\n");
}

}  // namespace twin::pictures
