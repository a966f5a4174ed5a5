#include "studies/batch/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>

#include "config/binding.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "results/trace/hdf5.hpp"

namespace twin::studies::batch {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A figure of the table.
struct Figure {
  const char* place;  ///< in summary.json
  const char* unit;
};
constexpr std::array<Figure, 9> kFigures{{{"machining_time_s", "s"},
                                          {"planned_time_s", "s"},
                                          {"path_length_mm", "mm"},
                                          {"contour_error_um/max", "um"},
                                          {"contour_error_um/rms", "um"},
                                          {"table_contour_error_um/max", "um"},
                                          {"table_contour_error_um/rms", "um"},
                                          {"tracking_error_um/x/max", "um"},
                                          {"tracking_error_um/y/max", "um"}}};

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
  const Json summary = parse_json(result.summary);
  const double time = figure(summary, "machining_time_s");
  return {std::isnan(time) ? figure(summary, "planned_time_s") : time,
          figure(summary, "contour_error_um/max")};
}

StoredResult figures_of(const StoredResult& result) {
  const Json summary = parse_json(result.summary);
  Json figures = Json::object();
  for (const auto& [place, unit] : kFigures) {
    if (const double value = figure(summary, place); !std::isnan(value)) {
      figures[Json::json_pointer("/" + std::string(place))] = value;
    }
  }
  return {twin::to_line(figures), result.failure};
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
  for (const auto& [place, unit] : kFigures) {
    text += column_of(place) + ",";
  }
  text += "failure,key\n";
  for (const Row& row : rows) {
    for (const std::string& value : row.point.values) {
      text += field(value) + ",";
    }
    const Json summary = parse_json(row.result.summary);
    for (const auto& [place, unit] : kFigures) {
      const double value = figure(summary, place);
      text += (std::isnan(value) ? std::string() : fmt::format("{:.9g}", value)) + ",";
    }
    text += field(row.result.failure) + "," + row.job.key + "\n";
  }
  return text;
}

namespace {

/// Values as numbers, or none of them if one is no number.
std::vector<double> numbers_of(const std::vector<std::string>& values) {
  std::vector<double> numbers;
  for (const std::string& value : values) {
    char* end = nullptr;
    numbers.push_back(std::strtod(value.c_str(), &end));
    if (value.empty() || *end != '\0') {
      return {};
    }
  }
  return numbers;
}

/// The unit of a setting as the machine file's bindings have it: "mm_per_s2" is mm/s^2.
std::string unit_of(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  config::MachineFile machine;
  const std::vector<config::Binding> bindings = config::bindings(machine);
  const config::Binding* const binding =
      dot == std::string::npos
          ? nullptr
          : config::find_binding(bindings, key.substr(0, dot), key.substr(dot + 1));
  return binding == nullptr || binding->unit.empty() ? "1" : config::pretty_unit(binding->unit);
}

results::Hdf5TableColumn column_of_values(const std::string& key, std::vector<std::string> values) {
  results::Hdf5TableColumn column{.column = {.name = key, .unit = unit_of(key)}};
  column.numbers = numbers_of(values);
  if (column.numbers.empty()) {
    column.texts = std::move(values);
  }
  return column;
}

}  // namespace

Expected<void> write_hdf5(const std::vector<std::string>& keys, const std::vector<Row>& rows,
                          const std::filesystem::path& file) {
  TWIN_TRY(const results::Hdf5Module* const module, results::hdf5_module());
  std::vector<results::Hdf5TableColumn> columns;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    std::vector<std::string> values;
    for (const Row& row : rows) {
      values.push_back(row.point.values[k]);
    }
    columns.push_back(column_of_values(keys[k], std::move(values)));
  }
  std::vector<Json> summaries;
  for (const Row& row : rows) {
    summaries.push_back(parse_json(row.result.summary));
  }
  for (const auto& [place, unit] : kFigures) {
    results::Hdf5TableColumn column{.column = {.name = column_of(place), .unit = unit}};
    for (const Json& summary : summaries) {
      column.numbers.push_back(figure(summary, place));
    }
    columns.push_back(std::move(column));
  }
  results::Hdf5TableColumn failures{.column = {.name = "failure"}};
  results::Hdf5TableColumn job_keys{.column = {.name = "key"}};
  for (const Row& row : rows) {
    failures.texts.push_back(row.result.failure);
    job_keys.texts.push_back(row.job.key);
  }
  columns.push_back(std::move(failures));
  columns.push_back(std::move(job_keys));
  TWIN_TRY(AtomicFile whole, AtomicFile::create(file, temporary_of(file)));
  TWIN_CHECK(module->write_table(whole.temporary(), columns));
  return whole.commit();
}

}  // namespace twin::studies::batch
