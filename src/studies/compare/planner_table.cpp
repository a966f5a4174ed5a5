#include "studies/compare/planner_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/rounded.hpp"
#include "core/units.hpp"
#include "studies/compare/jobs.hpp"
#include "studies/compare/verdict.hpp"

namespace twin::studies::compare {
namespace {

using Json = nlohmann::ordered_json;
using units::um_from_mm;

/// A column: its key, its heading in the table (none: only in the files), its value.
struct Column {
  const char* key;
  const char* head;
  int decimals;
  double (*get)(const PlannerRow& row);
};

constexpr std::array<Column, 10> kColumns{{
    {"path_length_mm", "path mm", 1, [](const PlannerRow& r) { return r.summary.path_length; }},
    {"planned_time_s", "time s", 3, [](const PlannerRow& r) { return r.summary.planned_time; }},
    {"time_bound_s", "bound s", 3, [](const PlannerRow& r) { return r.time_bound; }},
    {"bound_ratio", "ratio", 4,
     [](const PlannerRow& r) { return r.summary.planned_time / r.time_bound; }},
    {"certified_deviation_um", "certified um", 2,
     [](const PlannerRow& r) { return um_from_mm(r.deviation); }},
    {"command_contour_error_max_um", "measured um", 2,
     [](const PlannerRow& r) { return um_from_mm(r.summary.command_contour_error.max); }},
    {"command_contour_error_rms_um", "", 2,
     [](const PlannerRow& r) { return um_from_mm(r.summary.command_contour_error.rms); }},
    {"feedrate_fluctuation_max_percent", "", 4,
     [](const PlannerRow& r) { return 100.0 * r.summary.feedrate_fluctuation.max; }},
    {"blocks_per_segment", "blocks/ segment", 2,
     [](const PlannerRow& r) {
       return static_cast<double>(r.summary.blocks.total) /
              static_cast<double>(std::max<std::int64_t>(r.summary.segments.total, 1));
     }},
    {"planning_time_per_block_us", "us/block", 2,
     [](const PlannerRow& r) {
       return 1e6 * r.planning_time /
              static_cast<double>(std::max<std::int64_t>(r.summary.blocks.total, 1));
     }},
}};

/// Those of the table, few enough for a terminal.
std::vector<Column> shown_columns() {
  std::vector<Column> shown;
  std::copy_if(kColumns.begin(), kColumns.end(), std::back_inserter(shown),
               [](const Column& column) { return *column.head != '\0'; });
  return shown;
}

std::string csv_text(const std::vector<PlannerRow>& rows) {
  std::string text = "program,planner";
  for (const Column& column : kColumns) {
    text += fmt::format(",{}", column.key);
  }
  text += ",audit\n";
  for (const PlannerRow& row : rows) {
    text += fmt::format("\"{}\",{}", row.program, row.planner);
    for (const Column& column : kColumns) {
      text += fmt::format(",{:.6g}", column.get(row));
    }
    text += "," + row.verdict + "\n";
  }
  return text;
}

std::string json_text(const std::vector<PlannerRow>& rows) {
  Json json = Json::array();
  for (const PlannerRow& row : rows) {
    Json entry{{"program", row.program}, {"planner", row.planner}};
    for (const Column& column : kColumns) {
      entry[column.key] = rounded(column.get(row));
    }
    entry["audit"] = row.verdict;
    json.push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Adds what a plan by itself gives to a row.
Expected<void> complete(const studies::Job& job, PlannerRow& row) {
  const auto time = planning_time(job);
  const auto plan = bounded_plan(job.program, job.machine, job.feedrate, false);
  if (!time || !plan) {
    return tl::unexpected(!time ? time.error() : plan.error());
  }
  row.planning_time = *time;
  row.time_bound = plan->time_bound;
  row.deviation = plan->deviation;
  row.verdict = audit_verdict(row.summary.audit, job.machine.limits);
  return {};
}

}  // namespace

Expected<std::vector<PlannerRow>> planner_rows(const Request& request,
                                               const std::vector<std::filesystem::path>& programs) {
  std::vector<studies::Job> jobs;
  std::vector<PlannerRow> rows;
  for (const auto& program : programs) {
    const std::string file = program.filename().string();
    for (const std::string planner : kPlanners) {
      auto job = job_of(request, program, file + ", " + planner, {"planning.planner=" + planner});
      if (!job) {
        return tl::unexpected(std::move(job.error()));
      }
      job->has_machine = false;
      job->keeps_results = false;
      job->directory = request.folder / fmt::format("plan_{}", jobs.size());
      jobs.push_back(std::move(*job));
      rows.push_back({file, planner, {}, 0.0, 0.0, 0.0, {}});
    }
  }
  auto summaries = studies::run_jobs(jobs, request.running);
  if (!summaries) {
    return tl::unexpected(std::move(summaries.error()));
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    rows[i].summary = (*summaries)[i];
    if (auto done = complete(jobs[i], rows[i]); !done) {
      return tl::unexpected(std::move(done.error()));
    }
  }
  return rows;
}

TextTable grid_of_planners(const std::vector<PlannerRow>& rows) {
  TextTable grid;
  grid.title = "Planners, and the lower bound of the time of the path of each";
  for (const Column& column : shown_columns()) {
    grid.head.emplace_back(column.head);
  }
  grid.head.emplace_back("audit");
  std::string shown;
  for (const PlannerRow& row : rows) {
    Line line{row.program == shown ? "" : std::filesystem::path(row.program).stem().string(),
              row.planner,
              {},
              {}};
    shown = row.program;
    for (const Column& column : shown_columns()) {
      const double value = column.get(row);
      const bool is_absent =
          row.deviation == 0.0 && std::string_view(column.key) == "certified_deviation_um";
      line.cells.push_back({is_absent ? "-" : fmt::format("{:.{}f}", value, column.decimals)});
    }
    line.cells.push_back({row.verdict});
    grid.lines.push_back(std::move(line));
  }
  return grid;
}

Expected<void> write_planner_table(const std::vector<PlannerRow>& rows,
                                   const pictures::Workshop& workshop) {
  const std::pair<const char*, std::string> texts[] = {
      {"planners.csv", csv_text(rows)},
      {"planners.json", json_text(rows)},
      {"planners.md", "# Planners compared\n\n" + to_markdown(grid_of_planners(rows))}};
  std::vector<std::string> names;
  if (auto written = workshop.write(texts, names); !written) {
    return written;
  }
  return workshop.deliver(names);
}

}  // namespace twin::studies::compare
