#include "studies/compare/planner_table.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "core/json.hpp"
#include "results/quantities.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {
namespace {

/// A quantity of a plan, and its heading in the table; those without one are in the files only, for
/// a terminal is not wide enough for all.
struct Column {
  std::string_view key;
  const char* head = nullptr;
};

constexpr std::array<Column, 10> kColumns{{{"path_length_mm", "path mm"},
                                           {"planned_time_s", "time s"},
                                           {"time_bound_s", "bound s"},
                                           {"bound_ratio", "ratio"},
                                           {"certified_deviation_um", "certified um"},
                                           {"command_contour_error_max_um", "measured um"},
                                           {"command_contour_error_rms_um"},
                                           {"feedrate_fluctuation_max_percent"},
                                           {"blocks_per_segment", "blocks/ segment"},
                                           {"planning_time_per_block_us", "us/block"}}};

std::string csv_text(const std::vector<PlannerRow>& rows) {
  std::string text = "program,planner";
  for (const Column& column : kColumns) {
    text += fmt::format(",{}", column.key);
  }
  text += ",audit\n";
  for (const PlannerRow& row : rows) {
    text += fmt::format("{},{}", quote_csv(row.program), row.planner);
    for (const Column& column : kColumns) {
      const auto value = results::quantity(column.key).get(row.summary);
      text += value ? fmt::format(",{:.6g}", *value) : ",";
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
      entry[std::string(column.key)] =
          rounded_or_null(results::quantity(column.key).get(row.summary));
    }
    entry["audit"] = row.verdict;
    json.push_back(std::move(entry));
  }
  return to_text(json);
}

/// Adds what a plan by itself gives to a row.
Expected<void> complete(const studies::jobs::Job& job, PlannerRow& row) {
  TWIN_TRY(row.summary.planning_time, planning_time(job));
  TWIN_TRY(const BoundedPlan plan,
           bounded_plan(job.program, job.machine, job.feedrate, Profiles::kLeftOut));
  row.summary.time_bound = plan.time_bound_with_jerk;
  row.verdict = audit_verdict(row.summary.audit, job.machine.limits);
  return {};
}

constexpr double kDoubt = 1.05;
constexpr double kExact = 1.001;

/// The worst of the shares that passes what it may be.
class Worst {
 public:
  void see(std::string_view name, double value, double limit, double allowed) {
    const double share = limit > 0.0 ? value / limit : 0.0;
    if (share > allowed && share > share_) {
      name_ = name;
      share_ = share;
    }
  }

  std::string text() const {
    return share_ > 0.0 ? fmt::format("{} {:.2f}", name_, share_) : "kept";
  }

 private:
  std::string_view name_;
  double share_ = 0.0;
};

}  // namespace

Expected<std::vector<PlannerRow>> planner_rows(const Request& request,
                                               const std::vector<gcode::ProgramText>& programs) {
  std::vector<studies::jobs::Job> jobs;
  std::vector<PlannerRow> rows;
  for (const auto& program : programs) {
    const std::string file = program.file().filename().string();
    for (const std::string planner : kPlanners) {
      TWIN_TRY(studies::jobs::Job job,
               job_of(request, program, file + ", " + planner, {"planning.planner=" + planner}));
      job.has_machine = false;
      job.keeps_results = false;
      job.directory = request.folder / fmt::format("plan_{}", jobs.size());
      jobs.push_back(std::move(job));
      rows.push_back({.program = file, .planner = planner, .summary = {}, .verdict = {}});
    }
  }
  TWIN_TRY(std::vector<results::Summary> summaries, studies::jobs::run_jobs(jobs, request.running));
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    rows[i].summary = std::move(summaries[i]);
    TWIN_CHECK(complete(jobs[i], rows[i]));
  }
  return rows;
}

TextTable grid_of_planners(const std::vector<PlannerRow>& rows) {
  TextTable grid;
  grid.title = "Planners, and the lower bound of the time of the path of each";
  for (const Column& column : kColumns) {
    if (column.head != nullptr) {
      grid.head.emplace_back(column.head);
    }
  }
  grid.head.emplace_back("audit");
  std::string shown;
  for (const PlannerRow& row : rows) {
    const bool is_first = row.program != shown;
    Line line{.row = is_first ? std::filesystem::path(row.program).stem().string() : "",
              .what = row.planner,
              .cells = {},
              .note = {}};
    shown = row.program;
    for (const Column& column : kColumns) {
      const results::Quantity& q = results::quantity(column.key);
      if (column.head != nullptr) {
        line.cells.push_back({q.text(q.get(row.summary))});
      }
    }
    line.cells.push_back({row.verdict});
    grid.lines.push_back(std::move(line));
  }
  return grid;
}

Expected<void> write_planner_table(const std::vector<PlannerRow>& rows,
                                   const pictures::Workshop& workshop) {
  const pictures::NamedText texts[] = {
      {"planners.csv", csv_text(rows)},
      {"planners.json", json_text(rows)},
      {"planners.md", "# Planners compared\n\n" + to_markdown(grid_of_planners(rows))}};
  TWIN_TRY(const std::vector<std::string> names, workshop.write(texts));
  return workshop.deliver(names);
}

std::string audit_verdict(const results::AuditPeaks& peaks, const Limits& limits) {
  Worst worst;
  worst.see("feedrate", peaks.feedrate, limits.feedrate, kExact);
  worst.see("acceleration", peaks.tangential_acceleration, limits.acceleration, kDoubt);
  worst.see("normal", peaks.normal_acceleration, limits.acceleration, kDoubt);
  worst.see("jerk", peaks.tangential_jerk, limits.jerk, kDoubt);
  for (std::size_t i = 0; i < peaks.axis.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    worst.see("axis feedrate", peaks.axis[i].velocity, limits.axis_feedrate[axis], kExact);
    worst.see("axis acceleration", peaks.axis[i].acceleration, limits.axis_acceleration[axis],
              kExact);
    worst.see("axis jerk", peaks.axis[i].jerk, limits.axis_jerk[axis], kExact);
  }
  return worst.text();
}

}  // namespace twin::studies::compare
