#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/text_table.hpp"
#include "core/units.hpp"
#include "studies/circular/circular_report.hpp"

namespace twin::studies::circular {
namespace {

constexpr double kSlower = 0.999;  // of the programmed feedrate
constexpr double kLeastShown_um = 0.0005;
constexpr TextLayout kDeviations{
    .indent = 2, .row_width = 43, .cell_width = 8, .notes = Notes::kShown};
constexpr TextLayout kSpikes{.indent = 2, .row_width = 16, .cell_width = 8};

/// A length in um without a sign on what rounds to zero.
double shown_um(double mm) {
  const double um = units::um_from_mm(mm);
  return std::abs(um) < kLeastShown_um ? 0.0 : um;
}

Line line(std::string name, double table_mm, double encoder_mm) {
  return {.row = std::move(name),
          .what = {},
          .cells = {{fmt::format("{:.3f}", shown_um(table_mm))},
                    {fmt::format("{:.3f}", shown_um(encoder_mm))}},
          .note = "um"};
}

TextTable deviations_of(const Report& report) {
  const Deviations& table = report.table.deviations;
  const Deviations& encoder = report.encoder.deviations;
  TextTable text;
  text.row_head = "ISO 230-4";
  text.head = {"table", "encoder"};
  const char* const names[2] = {"counter-clockwise", "clockwise"};
  for (std::size_t i = 0; i < 2; ++i) {
    text.lines.push_back(line(fmt::format("circular deviation G, {}", names[i]),
                              table.sense[i].circular, encoder.sense[i].circular));
  }
  text.lines.push_back(
      line("bidirectional circular deviation G(b)", table.bidirectional, encoder.bidirectional));
  text.lines.push_back(line("circular hysteresis H", table.hysteresis, encoder.hysteresis));
  for (std::size_t i = 0; i < 2; ++i) {
    text.lines.push_back(line(fmt::format("radial deviation F max, {}", names[i]),
                              table.sense[i].radial_max, encoder.sense[i].radial_max));
    text.lines.push_back(line(fmt::format("radial deviation F min, {}", names[i]),
                              table.sense[i].radial_min, encoder.sense[i].radial_min));
  }
  text.lines.push_back(
      line("mean bidirectional radial deviation D", table.mean_radial, encoder.mean_radial));
  if (report.predicted) {
    text.lines.push_back({.row = "D predicted by Eq. 3 from the servo's gains",
                          .what = {},
                          .cells = {{fmt::format("{:.3f}", shown_um(*report.predicted))}, {}},
                          .note = "um"});
  }
  return text;
}

/// A spike is doubtful where the path ripples as much away from the reversals.
bool is_hidden(const Spike& spike, double ripple) {
  return shown_um(spike.height) != 0.0 && std::abs(spike.height) <= ripple;
}

void add_spike(Line& line, const Spike& spike, double ripple) {
  if (shown_um(spike.height) == 0.0) {
    line.cells.insert(line.cells.end(), {{"none"}, {}, {}});
    return;
  }
  line.cells.push_back({fmt::format("{:.2f}", units::um_from_mm(spike.height))});
  line.cells.push_back({fmt::format("{:.1f}", units::deg_from_rad(spike.angle))});
  line.cells.push_back({fmt::format("{:.1f}", units::deg_from_rad(spike.width)),
                        is_hidden(spike, ripple) ? Mark::kDoubtful : Mark::kNone});
}

std::string spikes_text(const std::array<ReversalSpikes, 2>& spikes) {
  TextTable table;
  table.row_head = "reversal spikes";
  table.head = {"ccw height um", "at deg", "width deg", "cw height um", "at deg", "width deg"};
  bool is_any_hidden = false;
  for (std::size_t q = 0; q < 4; ++q) {
    Line& line = table.lines.emplace_back();
    line.row = fmt::format("{:>3} deg, {} turns", 90 * q, q % 2 == 0 ? 'X' : 'Y');
    for (const ReversalSpikes& sense : spikes) {
      add_spike(line, sense.quadrant[q], sense.ripple);
      is_any_hidden = is_any_hidden || is_hidden(sense.quadrant[q], sense.ripple);
    }
  }
  std::string text = to_text(table, kSpikes);
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
  text += to_text(deviations_of(report), kDeviations);
  if (!report.predicted) {
    text += fmt::format("  no prediction of D by Eq. 3: {}\n", report.no_prediction);
  }
  return text + "\n" + spikes_text(report.table.spikes);
}

}  // namespace twin::studies::circular
