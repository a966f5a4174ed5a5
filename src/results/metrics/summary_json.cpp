#include "core/json.hpp"
#include "results/metrics/summary.hpp"
#include "results/quantities.hpp"

namespace twin::results {
namespace {

/// What is shown of the path where a run ended early; the rest is of the whole plan.
bool is_of_what_was_done(const Quantity& q) {
  return q.key == "path_length_mm" || q.key == "machining_time_s";
}

/// Adds the quantities of a group that the run has.
void add_group(Json& json, const Summary& summary, Group group) {
  const bool is_part = summary.early_end && group == Group::kPath;
  for (const Quantity& q : quantities()) {
    const auto value = q.get(summary);
    if (q.group != group || q.pointer.empty() || !value || (is_part && !is_of_what_was_done(q))) {
      continue;
    }
    Json& place = json[Json::json_pointer(std::string(q.pointer))];
    if (q.kind == QuantityKind::kCount) {
      place = static_cast<std::int64_t>(*value);
    } else {
      place = rounded(*value);
    }
  }
}

Json json_of(const Place& place) {
  return {{"t_s", rounded(place.t)},
          {"x_mm", rounded(place.position.x())},
          {"y_mm", rounded(place.position.y())},
          {"z_mm", rounded(place.position.z())},
          {"line", place.line},
          {"segment", place.segment}};
}

/// The largest values with their places, under the names that they have in the file.
Json maxima(const Summary& summary) {
  Json list = Json::object();
  for (const Quantity& q : quantities()) {
    const auto place = q.place == nullptr ? std::nullopt : q.place(summary);
    const auto value = q.get(summary);
    if (!place || !value) {
      continue;
    }
    Json entry{{"value", rounded(*value)}};
    entry.update(json_of(*place));
    list[std::string(q.key)] = std::move(entry);
  }
  return list;
}

Json json_of(const LoopFigures& loop) {
  return {{"bandwidth_Hz", rounded(loop.bandwidth_Hz)},
          {"phase_margin_deg", rounded(loop.phase_margin_deg)},
          {"gain_margin", rounded(loop.gain_margin)}};
}

Json json_of(const EarlyEnd& end) {
  Json json{{"reason", end.reason}};
  if (end.at) {
    json.update(json_of(*end.at));
  }
  return json;
}

Json json_of(const std::vector<OverrideRecord>& overrides) {
  Json list = Json::array();
  for (const OverrideRecord& change : overrides) {
    list.push_back({{"asked_at_s", rounded(change.asked_at)},
                    {"percent", rounded(change.percent)},
                    {"from_s", rounded(change.from)}});
  }
  return list;
}

/// The machine file as an object of sections.
Json json_of(const std::vector<Setting>& settings) {
  Json sections = Json::object();
  for (const Setting& setting : settings) {
    sections[setting.section][setting.key] =
        std::visit([](const auto& value) { return Json(value); }, setting.value);
  }
  return sections;
}

/// What the run was made from.
void add_origin(Json& json, const Summary& summary) {
  if (!summary.notes.empty()) {
    json["notes"] = summary.notes;
  }
  json["version"] = summary.version;
  json["command"] = summary.command;
  json["program_sha256"] = summary.program_sha256;
  for (const auto& [file, sha256] : summary.subprograms) {
    json["subprograms"].push_back({{"file", file}, {"sha256", sha256}});
  }
  json["settings"] = json_of(summary.settings);
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json;
  json["program"] = summary.program;
  json["machine"] = summary.machine;
  json["hal"] = summary.hal;
  json["planner"] = summary.planner;
  json["interpolator"] = summary.interpolator;
  json["simulated"] = summary.simulated;
  if (summary.early_end) {
    json["ended_early"] = json_of(*summary.early_end);
  }
  add_group(json, summary, Group::kRun);
  add_group(json, summary, Group::kPath);
  if (!summary.overrides.empty()) {
    json["override"] = json_of(summary.overrides);
  }
  add_group(json, summary, Group::kErrors);
  add_group(json, summary, Group::kCutting);
  add_group(json, summary, Group::kPeaks);
  add_group(json, summary, Group::kAxisPeaks);
  if (Json places = maxima(summary); !places.empty()) {
    json["maxima"] = std::move(places);
  }
  if (summary.loops) {
    json["loops"] = {{"x", json_of((*summary.loops)[0])}, {"y", json_of((*summary.loops)[1])}};
  }
  add_group(json, summary, Group::kCycle);
  add_group(json, summary, Group::kWallClock);
  if (summary.run && summary.run->realtime) {
    json["realtime"]["notes"] = summary.run->realtime->notes;
  }
  add_origin(json, summary);
  return to_text(json);
}

std::string reproducible(const std::string& summary_json) {
  Json json = parse_json(summary_json);
  for (const char* key : {"cycle_time_us", "real_time_factor", "command"}) {
    json.erase(key);
  }
  return to_text(json);
}

std::string to_reproducible_json(const Summary& summary) { return reproducible(to_json(summary)); }

}  // namespace twin::results
