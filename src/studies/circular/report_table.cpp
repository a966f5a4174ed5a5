#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/units.hpp"
#include "studies/circular/report.hpp"

namespace twin::studies::circular {
namespace {

constexpr int kNameWidth = 42;
constexpr double kSlower = 0.999;  // of the programmed feedrate
constexpr double kLeastShown_um = 0.0005;

/// A length in um without a sign on what rounds to zero.
double shown_um(double mm) {
  const double um = units::um_from_mm(mm);
  return std::abs(um) < kLeastShown_um ? 0.0 : um;
}

std::string row(std::string_view name, double table_mm, double encoder_mm) {
  return fmt::format("  {:<{}}{:>10.3f}{:>10.3f}  um\n", name, kNameWidth, shown_um(table_mm),
                     shown_um(encoder_mm));
}

std::string deviations_of(const Deviations& table, const Deviations& encoder) {
  std::string text =
      fmt::format("  {:<{}}{:>10}{:>10}\n", "ISO 230-4", kNameWidth, "table", "encoder");
  const char* const names[2] = {"counter-clockwise", "clockwise"};
  for (std::size_t i = 0; i < 2; ++i) {
    text += row(fmt::format("circular deviation G, {}", names[i]), table.sense[i].circular,
                encoder.sense[i].circular);
  }
  text += row("bidirectional circular deviation G(b)", table.bidirectional, encoder.bidirectional);
  text += row("circular hysteresis H", table.hysteresis, encoder.hysteresis);
  for (std::size_t i = 0; i < 2; ++i) {
    text += row(fmt::format("radial deviation F max, {}", names[i]), table.sense[i].radial_max,
                encoder.sense[i].radial_max);
    text += row(fmt::format("radial deviation F min, {}", names[i]), table.sense[i].radial_min,
                encoder.sense[i].radial_min);
  }
  return text +
         row("mean bidirectional radial deviation D", table.mean_radial, encoder.mean_radial);
}

std::string prediction_of(const Report& report) {
  if (!report.predicted) {
    return fmt::format("  no prediction of D by Eq. 3: {}\n", report.no_prediction);
  }
  return fmt::format("  {:<{}}{:>10.3f}{:>14}\n", "D predicted by Eq. 3 from the servo's gains",
                     kNameWidth, shown_um(*report.predicted), "um");
}

std::string spike_text(const Spike& spike, double ripple) {
  if (shown_um(spike.height) == 0.0) {
    return fmt::format("{:>12}{:>12}{:>11}", "none", "", "");
  }
  return fmt::format("{:>9.2f} um {:>7.1f} deg {:>5.1f} deg{}", units::um_from_mm(spike.height),
                     units::deg_from_rad(spike.angle), units::deg_from_rad(spike.width),
                     std::abs(spike.height) > ripple ? ' ' : '*');
}

std::string spikes_text(const std::array<ReversalSpikes, 2>& spikes) {
  std::string text =
      fmt::format("  {:<18}{:>12}{:>12}{:>10} {:>12}{:>12}{:>10}\n", "reversal spikes",
                  "ccw height", "at", "width", "cw height", "at", "width");
  bool is_any_hidden = false;
  for (std::size_t q = 0; q < 4; ++q) {
    text += fmt::format("  {:>3} deg, {} turns  ", 90 * q, q % 2 == 0 ? 'X' : 'Y');
    for (const ReversalSpikes& sense : spikes) {
      text += spike_text(sense.quadrant[q], sense.ripple);
      is_any_hidden = is_any_hidden || (shown_um(sense.quadrant[q].height) != 0.0 &&
                                        std::abs(sense.quadrant[q].height) <= sense.ripple);
    }
    text += '\n';
  }
  if (is_any_hidden) {
    text += fmt::format(
        "  * not above the ripple of the path away from the reversals, {:.2f} and {:.2f} um\n",
        units::um_from_mm(spikes[0].ripple), units::um_from_mm(spikes[1].ripple));
  }
  return text;
}

}  // namespace

std::string to_table(const Report& report) {
  std::string text =
      fmt::format("circular test on {} ({}), radius {:g} mm, {:g} mm/min\n", report.machine,
                  report.hal, report.radius, units::mm_per_min_from_mm_per_s(report.feedrate));
  const double reached = std::min(report.reached[0], report.reached[1]);
  if (reached < kSlower * report.feedrate) {
    text += fmt::format("the planner's limits let it run at {:.4g} mm/min only\n",
                        units::mm_per_min_from_mm_per_s(reached));
  }
  text += "table: true position, as a ballbar sees it; encoder: as the controller sees it\n\n";
  text += deviations_of(report.table.deviations, report.encoder.deviations);
  text += prediction_of(report);
  text += "\n" + spikes_text(report.table.spikes);
  return text;
}

}  // namespace twin::studies::circular
