#include "pictures/figure/figure_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pictures/plot/scripts.hpp"

namespace twin::pictures {
namespace {

using pictures::quoted;

constexpr int kTitle = 58;    // height of what stands above the panels [pixels]
constexpr int kCaption = 52;  // above each panel
constexpr int kAxis = 114;    // below each panel: numbers and label
constexpr int kLeft = 150;    // of the panels
constexpr int kFont = 22;     // [points of gnuplot's pixels]

constexpr int kLegend = 46;  // below the title, where there is one

/// Colours that colour-blind readers can tell apart (Okabe and Ito).
constexpr std::array<std::string_view, 4> kColours{"#0072B2", "#D55E00", "#009E73", "#606060"};

int height_of(const std::vector<Panel>& panels, int top) {
  int height = top;
  for (const Panel& panel : panels) {
    height += kCaption + panel.height + kAxis;
  }
  return height;
}

std::string head(const std::string& name) {
  std::string styles;
  for (std::size_t i = 1; i <= kColours.size(); ++i) {
    styles += fmt::format("set style line {} linecolor rgb '{}' linewidth 1.5\n", i, colour(i));
  }
  return fmt::format(
      "# Draws {0}.png and {0}.svg from the data beside it: gnuplot {0}.gp\n"
      "set datafile separator ','\n"
      "set encoding utf8\n"
      "set border 3 linecolor rgb '#404040'\n"
      "set tics nomirror out\n"
      "set grid linecolor rgb '#E0E0E0' linetype 1 linewidth 0.5\n"
      "set autoscale xfix\n"
      "unset key\n"
      "{1}",
      name, styles);
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
      "  set label {} at screen {:.5f}, screen {:.5f} left noenhanced\n"
      "  set xlabel {} offset 0, 0.3\n  set ylabel {} offset 0.5, 0\n{}"
      "  plot {}\n",
      x(kLeft), x(kLeft + kPanelWidth), y(top), y(top + panel.height), quoted(panel.caption),
      x(kLeft), y(top - kCaption / 2), quoted(panel.x_label), quoted(panel.y_label), panel.settings,
      panel.plot);
}

/// Names with a piece of their line, side by side at a height [share of the picture].
std::string legend_text(const std::vector<std::string>& legend, double y) {
  std::string text;
  const double width = static_cast<double>(kPanelWidth) / kFigureWidth /
                       static_cast<double>(std::max<std::size_t>(legend.size(), 1));
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const double x = static_cast<double>(kLeft) / kFigureWidth + width * static_cast<double>(i);
    text += fmt::format(
        "  set arrow from screen {0:.4f}, screen {2:.5f} to screen {1:.4f}, screen {2:.5f} nohead "
        "linestyle {3} linewidth 2.5\n"
        "  set label {4} at screen {5:.4f}, screen {2:.5f} left noenhanced\n",
        x, x + 0.045, y, i + 1, quoted(legend[i]), x + 0.06);
  }
  return text;
}

}  // namespace

std::string_view colour(std::size_t style) { return kColours[(style - 1) % kColours.size()]; }

std::string figure_script(const std::string& name, const std::string& title,
                          const std::vector<Panel>& panels,
                          const std::vector<std::string>& legend) {
  int top = kTitle + (legend.empty() ? 0 : kLegend);
  const int height = height_of(panels, top);
  const auto y = [&](int pixels) { return 1.0 - static_cast<double>(pixels) / height; };
  std::string text = head(name) + terminals(name, height);
  text += fmt::format(
      "  set multiplot\n  set label {} at screen 0.5, screen {:.5f} center noenhanced\n{}",
      quoted(title), y(kTitle / 2), legend_text(legend, y(kTitle + kLegend / 3)));
  for (const Panel& panel : panels) {
    top += kCaption;
    text += drawing(panel, top, height);
    text +=
        "  unset label\n  unset arrow\n  unset object\n  unset logscale\n  set format\n"
        "  set xtics autofreq\n  set ytics autofreq\n  set autoscale\n  set autoscale xfix\n";
    top += panel.height + kAxis;
  }
  return text + "  unset multiplot\n  unset output\n}\n";
}

}  // namespace twin::pictures
