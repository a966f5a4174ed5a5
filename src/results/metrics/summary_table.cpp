#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/units.hpp"
#include "results/metrics/summary.hpp"

namespace twin::results {
namespace {

constexpr int kNameWidth = 26;

/// A text of lines "  name   value".
class Lines {
 public:
  void line(std::string_view name, std::string_view value) {
    text_ += fmt::format("  {:<{}}{}\n", name, kNameWidth, value);
  }
  void columns(std::string_view name, std::string_view first, std::string_view second,
               std::string_view unit) {
    text_ += fmt::format("  {:<{}}{:>12}{:>12}{}{}\n", name, kNameWidth, first, second,
                         unit.empty() ? "" : "  ", unit);
  }
  void error_um(std::string_view name, const ErrorFigures& error) {
    columns(name, fmt::format("{:.3f}", units::um_from_mm(error.max)),
            fmt::format("{:.3f}", units::um_from_mm(error.rms)), "um");
  }
  void peak(std::string_view name, double value, double limit, std::string_view unit) {
    columns(name, fmt::format("{:.1f}", value), fmt::format("{:.1f}", limit), unit);
  }
  void gap() { text_ += '\n'; }
  void title(std::string_view text) { text_ += fmt::format("{}\n", text); }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string plural(std::int64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string title_of(const Summary& s) {
  const std::string machine =
      s.run ? fmt::format("{} ({}{})", s.machine, s.hal, s.simulated ? ", simulated" : "")
            : fmt::format("{} (plan only)", s.machine);
  return fmt::format("{} on {}, {} interpolator, period {:g} ms", s.program, machine,
                     s.interpolator, s.period * 1e3);
}

/// "50 % from 2.034 s, hold from 3.500 s": the first few changes.
std::string override_text(const std::vector<OverrideRecord>& overrides) {
  constexpr std::size_t kMost = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(overrides.size(), kMost); ++i) {
    const OverrideRecord& change = overrides[i];
    text += text.empty() ? "" : ", ";
    text += change.percent == 0.0 ? "hold" : fmt::format("{:g} %", change.percent);
    text += fmt::format(" from {:.3f} s", change.from);
  }
  return overrides.size() > kMost ? fmt::format("{}, and {} more", text, overrides.size() - kMost)
                                  : text;
}

void add_path(Lines& table, const Summary& s) {
  table.line("blocks", fmt::format("{}, {} of them short, {:.3f} to {:.3f} mm, mean {:.3f} mm",
                                   s.blocks.total, s.blocks.short_blocks, s.blocks.length_min,
                                   s.blocks.length_max, s.blocks.length_mean));
  table.line("segments",
             fmt::format("{}: {}, {}, {}", s.segments.total, plural(s.segments.curves, "curve"),
                         plural(s.segments.lines, "line"), plural(s.segments.arcs, "arc")));
  if (s.certified) {
    table.line("spans", fmt::format("{}", s.certified->spans));
    table.line("certified deviation",
               fmt::format("{:.3f} um", units::um_from_mm(s.certified->deviation)));
  }
  table.line("compression factor", fmt::format("{:.2f}", s.compression_factor));
  table.line("path length", fmt::format("{:.3f} mm", s.path_length));
  table.line("planned time",
             s.time_bound ? fmt::format("{:.3f} s, {:.4f} of the bound of {:.3f} s", s.planned_time,
                                        s.planned_time / *s.time_bound, *s.time_bound)
                          : fmt::format("{:.3f} s", s.planned_time));
  if (!s.overrides.empty()) {
    table.line("feed override", override_text(s.overrides));
  }
  if (s.run) {
    table.line("machining time", fmt::format("{:.3f} s, {:.1f} x real time", s.run->machining_time,
                                             s.run->real_time_factor));
    table.line("cycle time", fmt::format("{:.2f} us median, {:.2f} us p99, {:.2f} us max",
                                         s.run->cycle_time.p50 * 1e6, s.run->cycle_time.p99 * 1e6,
                                         s.run->cycle_time.max * 1e6));
  }
}

void add_realtime(Lines& table, const RealTimeFigures& r) {
  const auto times = [&](std::string_view name, const TimeFigures& t) {
    table.line(name, fmt::format("{:>12.1f}{:>12.1f}{:>12.1f}{:>12.1f}  us", t.p50 * 1e6,
                                 t.p99 * 1e6, t.p999 * 1e6, t.max * 1e6));
  };
  table.line("wall clock",
             fmt::format("{:>12}{:>12}{:>12}{:>12}", "median", "p99", "p99.9", "max"));
  times("wake-up after deadline", r.wake_up);
  times("computation", r.compute);
  times("deadline to output", r.total);
  table.line("late periods",
             r.late_periods == 0
                 ? fmt::format("none, worst {:.1f} us after its deadline", r.worst_latency * 1e6)
                 : fmt::format("{}, worst {:.1f} us after its deadline", r.late_periods,
                               r.worst_latency * 1e6));
  for (const std::string& note : r.notes) {
    table.line("note", note);
  }
}

void add_errors(Lines& table, const Summary& s) {
  table.columns("", "max", "rms", "");
  table.error_um("contour error, command", s.command_contour_error);
  if (s.run) {
    table.error_um("contour error, encoder", s.run->contour_error);
    table.error_um("contour error, table", s.run->table_contour_error);
    table.error_um("tracking error, x", s.run->tracking_error[0]);
    table.error_um("tracking error, y", s.run->tracking_error[1]);
  }
  table.columns("feedrate fluctuation", fmt::format("{:.4f}", 1e2 * s.feedrate_fluctuation.max),
                fmt::format("{:.4f}", 1e2 * s.feedrate_fluctuation.rms), "%");
}

void add_peaks(Lines& table, const Summary& s, const Limits& limits) {
  table.columns("", "peak", "limit", "");
  table.peak("feedrate", s.audit.feedrate, limits.feedrate, "mm/s");
  table.peak("tangential acceleration", s.audit.tangential_acceleration, limits.acceleration,
             "mm/s^2");
  table.peak("normal acceleration", s.audit.normal_acceleration, limits.acceleration, "mm/s^2");
  table.peak("tangential jerk", s.audit.tangential_jerk, limits.jerk, "mm/s^3");
}

}  // namespace

std::string to_table(const Summary& summary, const Limits& limits) {
  Lines table;
  table.title(title_of(summary));
  table.gap();
  add_path(table, summary);
  table.gap();
  if (summary.run && summary.run->realtime) {
    add_realtime(table, *summary.run->realtime);
    table.gap();
  }
  add_errors(table, summary);
  table.gap();
  add_peaks(table, summary, limits);
  return table.take();
}

}  // namespace twin::results
