#include "shadow/report.hpp"

#include <fmt/format.h>

#include "core/json.hpp"

namespace twin::shadow {
namespace {

constexpr std::array<const char*, hal::kServoAxes> kReportKeys{"x", "y"};

Json json_of(const Finding& finding) {
  Json json;
  const Hypothesis& cause = finding.cause;
  json["cause"] = name_of(cause.cause);
  json["words"] = fmt::format("{} {}", words_of(cause.cause),
                              amount_of(cause.cause, cause.change, cause.deviation));
  json["change"] = rounded(cause.change);
  json["deviation"] = rounded(cause.deviation);
  json["since_s"] = rounded(cause.since.time);
  json["since_line"] = cause.since.line;
  json["noticed_s"] = rounded(finding.noticed.time);
  json["found_s"] = rounded(finding.found.time);
  json["found_line"] = finding.found.line;
  json["statistic"] = rounded(finding.statistic);
  json["threshold"] = rounded(finding.threshold);
  json["channel"] = name_of(finding.channel);
  json["cannot_be_told_from"] = Json::array();
  for (const Cause other : finding.or_else) {
    json["cannot_be_told_from"].push_back(name_of(other));
  }
  return json;
}

Json json_of(const AxisReport& axis) {
  Json json;
  json["motion_s"] = rounded(axis.motion);
  json["models"] = axis.models;
  json["finding"] = axis.found ? json_of(*axis.found) : Json(nullptr);
  json["finding_at_the_end"] = axis.last ? json_of(*axis.last) : Json(nullptr);
  json["parameters"] = Json::object();
  for (const AxisShadow::Estimate& estimate : axis.estimates) {
    Json& one = json["parameters"][std::string(name_of(estimate.channel))]
                    [std::string(name_of(estimate.cause))];
    one["change"] = rounded(estimate.change);
    one["deviation"] = rounded(estimate.deviation);
  }
  Json times = Json::array();
  Json levels = Json::array();
  for (const StripPoint& point : axis.strip) {
    times.push_back(rounded(point.time));
    levels.push_back(rounded(point.level));
  }
  json["strip"] = {{"t_s", std::move(times)}, {"level", std::move(levels)}};
  return json;
}

}  // namespace

ShadowReport make_report(const Shadow& shadow, const Baseline& baseline,
                         const config::MachineFile& machine) {
  ShadowReport report;
  report.learnt_from = baseline.programs;
  report.hours = machine.shadow.hours;
  report.period = machine.period;
  report.stops = machine.shadow.stops;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const AxisShadow* const one = shadow.axis(axis);
    if (one == nullptr) {
      continue;
    }
    AxisReport& seen = report.axis[axis];
    seen.is_watched = true;
    seen.motion = one->motion();
    seen.models = one->models();
    seen.found = one->finding();
    seen.last = one->last_finding();
    seen.estimates = one->estimates();
    seen.strip = one->strip();
  }
  return report;
}

std::string to_json(const ShadowReport& report) {
  Json json;
  json["reaction"] = report.stops ? "stop" : "warn";
  json["learnt_from"] = report.learnt_from;
  json["switched_off"] = report.switched_off.empty() ? Json(nullptr) : Json(report.switched_off);
  json["false_alarm_hours"] = rounded(report.hours);
  json["periods"] = report.periods;
  json["cost_us_per_period"] = rounded(1e6 * report.cost);
  json["cost_share_of_period"] = rounded(report.period > 0.0 ? report.cost / report.period : 0.0);
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    if (report.axis[axis].is_watched) {
      json["axes"][kReportKeys[axis]] = json_of(report.axis[axis]);
    }
  }
  json["trends"] = report.trends;
  return twin::to_text(json);
}

std::string to_text(const ShadowReport& report) {
  std::string text;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const AxisReport& seen = report.axis[axis];
    if (!seen.is_watched) {
      continue;
    }
    if (seen.last) {
      text += to_line(*seen.last, axis) + "\n";
    } else {
      double level = 0.0;
      for (const StripPoint& point : seen.strip) {
        level = std::max(level, point.level);
      }
      text += fmt::format(
          "axis {}: nothing has changed in {:.1f} s of motion; at most {:.0f} % of "
          "the threshold\n",
          kReportKeys[axis], seen.motion, 100.0 * level);
    }
  }
  for (const std::string& trend : report.trends) {
    text += trend + "\n";
  }
  return text;
}

}  // namespace twin::shadow
