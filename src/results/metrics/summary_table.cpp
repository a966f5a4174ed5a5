#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/text_table.hpp"
#include "results/metrics/summary.hpp"
#include "results/quantities.hpp"

namespace twin::results {
namespace {

constexpr std::size_t kMostOverrides = 4;  // changes of the override that are named

// Texts and numbers of all parts of the table stand in line.
constexpr TextLayout kTexts{.indent = 2, .row_width = 24};
constexpr TextLayout kNumbers{
    .indent = 2, .row_width = 27, .cell_width = 10, .notes = Notes::kShown};

/// A quantity of the run as text, without its unit.
std::string value(const Summary& s, std::string_view key) {
  const Quantity& q = quantity(key);
  return q.text(q.get(s));
}

/// "455.123 mm"
std::string with_unit(const Summary& s, std::string_view key) {
  const std::string_view unit = quantity(key).unit;
  return value(s, key) + (unit.empty() ? "" : " ") + std::string(unit);
}

/// "75 curves"
std::string counted(const Summary& s, std::string_view key, std::string_view noun) {
  const std::string count = value(s, key);
  return fmt::format("{} {}{}", count, noun, count == "1" ? "" : "s");
}

std::string title_of(const Summary& s) {
  const std::string machine =
      s.run ? fmt::format("{} ({}{})", s.machine, s.hal, s.simulated ? ", simulated" : "")
            : fmt::format("{} (plan only)", s.machine);
  const std::string planner = s.planner == "certified"
                                  ? s.planner + " planner"
                                  : fmt::format("{} planner, {}", s.planner, s.interpolator);
  return fmt::format("{} on {}, {}, period {:g} ms", s.program, machine, planner, s.period * 1e3);
}

/// "50 % from 2.034 s, hold from 3.500 s": the first few changes.
std::string override_text(const std::vector<OverrideRecord>& overrides) {
  std::string text;
  for (std::size_t i = 0; i < std::min(overrides.size(), kMostOverrides); ++i) {
    const OverrideRecord& change = overrides[i];
    text += text.empty() ? "" : ", ";
    text += change.percent == 0.0 ? "hold" : fmt::format("{:g} %", change.percent);
    text += fmt::format(" from {:.3f} s", change.from);
  }
  return overrides.size() > kMostOverrides
             ? fmt::format("{}, and {} more", text, overrides.size() - kMostOverrides)
             : text;
}

void add(TextTable& table, std::string_view name, std::string text) {
  table.lines.push_back(
      {.row = std::string(name), .what = std::move(text), .cells = {}, .note = {}});
}

/// "26.870 um at line 2788, X-44.05 Y12.14, 22.763 s"
std::string placed(const Summary& s, std::string_view key, const Place& place) {
  return fmt::format("{} at line {}, X{:.2f} Y{:.2f}, {:.3f} s", with_unit(s, key), place.line,
                     place.position.x(), place.position.y(), place.t);
}

/// Times of a run, and where its contour error was largest.
void add_run(TextTable& table, const Summary& s) {
  if (!s.overrides.empty()) {
    add(table, "feed override", override_text(s.overrides));
  }
  if (s.run) {
    add(table, "machining time",
        fmt::format("{}, {} x real time", with_unit(s, "machining_time_s"),
                    value(s, "real_time_factor")));
    add(table, "computing time of cycle",
        fmt::format("{} median, {} p99, {} max", with_unit(s, "cycle_time_p50_us"),
                    with_unit(s, "cycle_time_p99_us"), with_unit(s, "cycle_time_max_us")));
    if (const auto& worst = s.run->contour_error.at) {
      add(table, "largest contour error", placed(s, "contour_error_max_um", *worst));
    }
  }
  for (std::size_t i = 0; s.loops && i < s.loops->size(); ++i) {
    const LoopFigures& loop = (*s.loops)[i];
    add(table, fmt::format("position loop, {:c}", "xy"[i]),
        fmt::format("bandwidth {:.1f} Hz, phase margin {:.1f} deg, gain margin {:.2f}",
                    loop.bandwidth_Hz, loop.phase_margin_deg, loop.gain_margin));
  }
  for (const std::string& note : s.notes) {
    add(table, "note", note);
  }
}

/// What there is to say of a run that ended early.
TextTable done_table(const Summary& s) {
  TextTable table;
  add(table, "ended early",
      fmt::format("at line {}, {:.3f} s", s.early_end->at->line, s.early_end->at->t));
  add(table, "path length until then", with_unit(s, "path_length_mm"));
  add_run(table, s);
  return table;
}

TextTable path_table(const Summary& s) {
  TextTable table;
  add(table, "blocks",
      fmt::format("{}, {} of them short", value(s, "blocks"), value(s, "short_blocks")));
  add(table, "length of short blocks",
      fmt::format("{} to {}, mean {}", value(s, "block_length_min_mm"),
                  with_unit(s, "block_length_max_mm"), with_unit(s, "block_length_mean_mm")));
  add(table, "segments",
      fmt::format("{}: {}, {}, {}", value(s, "segments"), counted(s, "curves", "curve"),
                  counted(s, "lines", "line"), counted(s, "arcs", "arc")));
  if (s.certified) {
    add(table, "spans", value(s, "spans"));
    add(table, "certified deviation", with_unit(s, "certified_deviation_um"));
  }
  add(table, "compression factor", value(s, "compression_factor"));
  add(table, "path length", with_unit(s, "path_length_mm"));
  std::string time = with_unit(s, "planned_time_s");
  if (s.time_bound) {
    time += fmt::format(", {} of the bound of {}", value(s, "bound_ratio"),
                        with_unit(s, "time_bound_s"));
  }
  add(table, "planned time", time);
  if (s.plan_fallbacks > 0) {
    add(table, "plan fallbacks",
        fmt::format("{}: there is no plan within all limits, and a slower one or one that stops "
                    "was taken",
                    value(s, "plan_fallbacks")));
  }
  add_run(table, s);
  return table;
}

/// Quantities of a group that the run has: a line for each label, a column for each statistic.
TextTable statistics_table(const Summary& s, Group group) {
  TextTable table;
  for (const Quantity& q : quantities()) {
    const auto measured = q.get(s);
    if (q.group != group || q.statistic.empty() || !measured) {
      continue;
    }
    if (table.lines.empty() || table.lines.back().row != q.label) {
      table.lines.push_back(
          {.row = std::string(q.label), .what = {}, .cells = {}, .note = std::string(q.unit)});
    }
    table.lines.back().cells.push_back({q.text(measured)});
    if (table.lines.size() == 1) {
      table.head.emplace_back(q.statistic);
    }
  }
  return table;
}

std::string wall_clock_text(const Summary& s, const RealTimeStats& stats) {
  TextTable times = statistics_table(s, Group::kWallClock);
  times.row_head = "wall clock";
  TextTable texts;
  add(texts, "late periods",
      fmt::format("{}, worst {} after its deadline",
                  stats.late_periods == 0 ? "none" : value(s, "late_periods"),
                  with_unit(s, "worst_latency_us")));
  for (const std::string& note : stats.notes) {
    add(texts, "note", note);
  }
  return to_text(times, kNumbers) + to_text(texts, kTexts);
}

/// Whether a part of the run is no cutting motion, so that figures without it say more.
bool has_rapids(const Summary& s) {
  return s.run && s.cutting && s.cutting->time < 0.99 * s.run->machining_time;
}

/// What is to be thought of a peak beside its limit: differences of set points leave it in doubt by 5 % of the limit (LimitAudit).
std::string_view verdict(double peak, double limit) {
  constexpr double kPrinted = 1.0005;
  constexpr double kDoubt = 1.05;
  const double share = peak / limit;
  return share <= kPrinted ? "kept" : share <= kDoubt ? "kept, doubt 5 %" : "exceeded";
}

/// Peaks along the path beside their limits.
TextTable peaks_table(const Summary& s, const Limits& limits) {
  TextTable table = statistics_table(s, Group::kPeaks);
  table.head.emplace_back("limit");
  std::size_t line = 0;
  for (const Quantity& q : quantities()) {
    if (q.group == Group::kPeaks) {
      Line& row = table.lines[line++];
      const double limit = q.limit(limits);
      row.cells.push_back({q.text(limit)});
      row.note = fmt::format("{:<6}  {}", row.note, verdict(q.get(s).value_or(0.0), limit));
    }
  }
  return table;
}

}  // namespace

std::string to_table(const Summary& summary, const Limits& limits) {
  if (summary.early_end && !summary.early_end->at) {
    return title_of(summary) + "\n\n  nothing moved\n";
  }
  std::string text =
      title_of(summary) + "\n\n" +
      to_text(summary.early_end ? done_table(summary) : path_table(summary), kTexts) + "\n";
  if (summary.run && summary.run->realtime) {
    text += wall_clock_text(summary, *summary.run->realtime) + "\n";
  }
  TextTable errors = statistics_table(summary, Group::kErrors);
  if (has_rapids(summary)) {
    for (Line& line : statistics_table(summary, Group::kCutting).lines) {
      errors.lines.push_back(std::move(line));
    }
  }
  return text + to_text(errors, kNumbers) + "\n" + to_text(peaks_table(summary, limits), kNumbers);
}

}  // namespace twin::results
