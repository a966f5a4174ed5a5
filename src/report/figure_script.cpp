#include "report/figure_script.hpp"

#include <fmt/format.h>

namespace twin::report {
namespace {

constexpr int kTitle = 58;    // height of what stands above the panels [pixels]
constexpr int kCaption = 52;  // above each panel
constexpr int kAxis = 114;    // below each panel: numbers and label
constexpr int kLeft = 150;    // of the panels
constexpr int kFont = 22;     // [points of gnuplot's pixels]

/// A gnuplot string constant; a quote is written twice.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? "''" : std::string(1, c);
  }
  return result + "'";
}

int height_of(const std::vector<Panel>& panels) {
  int height = kTitle;
  for (const Panel& panel : panels) {
    height += kCaption + panel.height + kAxis;
  }
  return height;
}

std::string head(const std::string& name) {
  return fmt::format(
      "# Draws {0}.png and {0}.svg from the data beside it: gnuplot {0}.gp\n"
      "set datafile separator ','\n"
      "set encoding utf8\n"
      "set border 3 linecolor rgb '#404040'\n"
      "set tics nomirror out\n"
      "set grid linecolor rgb '#E0E0E0' linetype 1 linewidth 0.5\n"
      "set autoscale xfix\n"
      "unset key\n"
      "set style line 1 linecolor rgb '#0072B2' linewidth 1.5\n"
      "set style line 2 linecolor rgb '#D55E00' linewidth 1.5\n"
      "set style line 3 linecolor rgb '#009E73' linewidth 1.5\n"
      "set style line 4 linecolor rgb '#606060' linewidth 1.5\n",
      name);
}

std::string terminals(const std::string& name, int height) {
  return fmt::format(
      "has_cairo = strstrt(GPVAL_TERMINALS, 'pngcairo') > 0\n"
      "do for [kind in 'png svg'] {{\n"
      "  if (kind eq 'svg') {{\n"
      "    set terminal svg size {1},{2} font 'DejaVu Sans,{5}' background '#FFFFFF'\n"
      "  }} else {{ if (has_cairo) {{\n"
      "    set terminal pngcairo size {3},{4} font 'DejaVu Sans,{6}' linewidth 2\n"
      "  }} else {{\n"
      "    set terminal png truecolor size {3},{4} font 'DejaVu Sans,{6}' linewidth 2\n"
      "  }} }}\n"
      "  set output '{0}.'.kind\n",
      name, kFigureWidth / 2, height / 2, kFigureWidth, height, kFont / 2, kFont);
}

/// One panel, its upper edge `top` pixels below that of the picture.
std::string drawing(const Panel& panel, int top, int height) {
  const auto y = [&](int pixels) { return 1.0 - static_cast<double>(pixels) / height; };
  const auto x = [](int pixels) { return static_cast<double>(pixels) / kFigureWidth; };
  return fmt::format(
      "  set lmargin at screen {:.5f}\n  set rmargin at screen {:.5f}\n"
      "  set tmargin at screen {:.5f}\n  set bmargin at screen {:.5f}\n"
      "  set label 1 {} at screen {:.5f}, screen {:.5f} left noenhanced\n"
      "  set xlabel {} offset 0, 0.3\n  set ylabel {} offset 0.5, 0\n{}"
      "  plot {}\n",
      x(kLeft), x(kLeft + kPanelWidth), y(top), y(top + panel.height), quoted(panel.caption),
      x(kLeft), y(top - kCaption / 2), quoted(panel.x_label), quoted(panel.y_label), panel.settings,
      panel.plot);
}

}  // namespace

std::string figure_script(const std::string& name, const std::string& title,
                          const std::vector<Panel>& panels) {
  const int height = height_of(panels);
  std::string text = head(name) + terminals(name, height);
  text += fmt::format(
      "  set multiplot\n  set label 2 {} at screen 0.5, screen {:.5f} center "
      "noenhanced\n",
      quoted(title), 1.0 - static_cast<double>(kTitle) / 2 / height);
  int top = kTitle;
  for (const Panel& panel : panels) {
    top += kCaption;
    text += drawing(panel, top, height);
    text +=
        "  unset label\n  unset arrow\n  unset object\n  set ytics autofreq\n  set autoscale\n  "
        "set autoscale xfix\n";
    top += panel.height + kAxis;
  }
  return text + "  unset multiplot\n  unset output\n}\n";
}

}  // namespace twin::report
