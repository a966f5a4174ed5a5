#include "studies/batch/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/json.hpp"

namespace twin::studies::batch {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Figures of the table, by their place in summary.json.
constexpr std::array<const char*, 9> kFigures{
    "machining_time_s",           "planned_time_s",          "path_length_mm",
    "contour_error_um/max",       "contour_error_um/rms",    "table_contour_error_um/max",
    "table_contour_error_um/rms", "tracking_error_um/x/max", "tracking_error_um/y/max"};

double figure(const Json& summary, const std::string& place) {
  const Json::json_pointer pointer("/" + place);
  return summary.is_object() && summary.contains(pointer) && summary[pointer].is_number()
             ? summary[pointer].get<double>()
             : kNone;
}

/// The column of a figure: "contour_error_um/max" is contour_error_max_um.
std::string column_of(std::string place) {
  const std::size_t slash = place.find('/');
  if (slash == std::string::npos) {
    return place;
  }
  std::string rest = place.substr(slash + 1);
  std::ranges::replace(rest, '/', '_');
  const std::string name = place.substr(0, slash);
  const std::size_t unit = name.rfind('_');
  return name.substr(0, unit) + "_" + rest + name.substr(unit);
}

/// A field of CSV, quoted where it must be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? " " : std::string(1, c);
  }
  return quoted + "\"";
}

}  // namespace

Merit merit_of(const StoredResult& result) {
  const Json summary = Json::parse(result.summary, nullptr, false);
  const double time = figure(summary, "machining_time_s");
  return {std::isnan(time) ? figure(summary, "planned_time_s") : time,
          figure(summary, "contour_error_um/max")};
}

std::vector<Candidate> candidates_of(const std::vector<std::string>& keys,
                                     const std::vector<Row>& rows) {
  std::vector<Candidate> candidates;
  std::map<std::vector<std::string>, std::size_t> known;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> values = rows[i].point.values;
    for (std::size_t k = keys.size(); k-- > 0;) {
      if (keys[k] == "program") {
        values.erase(values.begin() + static_cast<std::ptrdiff_t>(k));
      }
    }
    const auto [place, is_new] = known.emplace(values, candidates.size());
    if (is_new) {
      candidates.push_back({std::move(values), {0.0, 0.0}, {}, i});
    }
    Candidate& candidate = candidates[place->second];
    const Merit merit = merit_of(rows[i].result);
    candidate.merit.time += merit.time;
    const bool is_known = !std::isnan(candidate.merit.contour_error);
    candidate.merit.contour_error =
        is_known && !std::isnan(merit.contour_error)
            ? std::max(candidate.merit.contour_error, merit.contour_error)
            : kNone;
    if (candidate.failure.empty()) {
      candidate.failure = rows[i].result.failure;
    }
  }
  return candidates;
}

std::vector<std::size_t> pareto_front(const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Merit& merit = candidates[i].merit;
    if (!std::isnan(merit.time) && !std::isnan(merit.contour_error)) {
      order.push_back(i);
    }
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const Merit& first = candidates[a].merit;
    const Merit& second = candidates[b].merit;
    return std::pair(first.time, first.contour_error) <
           std::pair(second.time, second.contour_error);
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (candidates[i].merit.contour_error < least) {
      least = candidates[i].merit.contour_error;
      front.push_back(i);
    }
  }
  return front;
}

std::string to_csv(const std::vector<std::string>& keys, const std::vector<Row>& rows) {
  std::string text;
  for (const std::string& key : keys) {
    text += field(key) + ",";
  }
  for (const char* const place : kFigures) {
    text += column_of(place) + ",";
  }
  text += "failure,key\n";
  for (const Row& row : rows) {
    for (const std::string& value : row.point.values) {
      text += field(value) + ",";
    }
    const Json summary = Json::parse(row.result.summary, nullptr, false);
    for (const char* const place : kFigures) {
      const double value = figure(summary, place);
      text += (std::isnan(value) ? std::string() : fmt::format("{:.9g}", value)) + ",";
    }
    text += field(row.result.failure) + "," + row.job.key + "\n";
  }
  return text;
}

}  // namespace twin::studies::batch
