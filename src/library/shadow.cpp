#include "twin/shadow.hpp"

#include <algorithm>
#include <iterator>

#include "core/stop_wish.hpp"
#include "library/inside.hpp"
#include "session/results.hpp"
#include "shadow/report.hpp"
#include "shadow/shadow.hpp"
#include "studies/shadow/recorded_track.hpp"
#include "studies/shadow/watched_track.hpp"

namespace twin {
namespace {

std::vector<shadow::Track> tracks_of(const std::vector<std::string>& traces,
                                     const std::string& columns, const config::MachineFile& machine,
                                     const std::atomic<bool>* stop) {
  const auto map = value_of(studies::identify::parse_columns(columns));
  std::vector<shadow::Track> tracks;
  for (const std::string& trace : traces) {
    check(check_wish(stop, "interrupted"));
    std::ranges::move(value_of(studies::shadow::read_tracks(trace, map, machine)),
                      std::back_inserter(tracks));
  }
  return tracks;
}

ShadowFinding finding_of(const shadow::Finding& found, hal::Axis axis) {
  ShadowFinding finding;
  finding.axis = axis == hal::kX ? "x" : "y";
  finding.cause = shadow::name_of(found.cause.cause);
  finding.change = found.cause.change;
  finding.deviation = found.cause.deviation;
  finding.since = found.cause.since.time;
  finding.found = found.found.time;
  for (const shadow::Cause other : found.or_else) {
    finding.or_else.emplace_back(shadow::name_of(other));
  }
  finding.text = shadow::to_line(found, axis);
  return finding;
}

}  // namespace

ShadowReport Inside::report(const shadow::ShadowReport& seen, const std::string& trace) {
  ShadowReport report;
  report.trace = trace;
  report.switched_off = seen.switched_off;
  report.table = shadow::to_text(seen);
  report.json = shadow::to_json(seen);
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    if (seen.axis[axis].last) {
      report.findings.push_back(finding_of(*seen.axis[axis].last, axis));
    }
  }
  return report;
}

std::string learn_shadow(const std::vector<std::string>& traces, const Settings& settings,
                         const std::string& file, const std::string& columns,
                         const std::atomic<bool>* stop) {
  const config::MachineFile& machine = Inside::of(settings);
  check(shadow::check_identified(machine));
  const auto tracks = tracks_of(traces, columns, machine, stop);
  check(session::prepare_output_file(file));
  const auto baseline =
      value_of(shadow::learn(machine, tracks, value_of(shadow::screws_give(machine)), stop));
  check(shadow::write_baseline(file, baseline));
  return shadow::to_text(baseline, machine);
}

std::vector<ShadowReport> watch(const std::vector<std::string>& traces, const Settings& settings,
                                const std::string& learnt, const std::string& columns,
                                const std::atomic<bool>* stop) {
  const config::MachineFile& machine = Inside::of(settings);
  check(shadow::check_identified(machine));
  const bool gives = value_of(shadow::screws_give(machine));
  std::vector<ShadowReport> reports;
  for (const shadow::Track& track : tracks_of(traces, columns, machine, stop)) {
    reports.push_back(Inside::report(
        value_of(studies::shadow::watch_track(machine, track, learnt, gives, stop)), track.name));
  }
  return reports;
}

}  // namespace twin
