#include "studies/reproduce/reproduction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "config/find_file.hpp"
#include "core/units.hpp"
#include "studies/reproduce/published_columns.hpp"

namespace twin::studies::reproduce {
namespace {

/// The runs that are needed, each once.
class Plan {
 public:
  explicit Plan(const Request& request) : request_(request) {}

  /// Index of a row's single run among the jobs; its repeats follow it.
  Expected<std::size_t> add(const PublishedRow& row, const std::vector<std::string>& settings) {
    std::vector<std::string> all = request_.settings;
    all.emplace_back("planning.planner=paper");
    all.push_back("path.curves=" + row.interpolator);
    all.insert(all.end(), settings.begin(), settings.end());
    const std::string key =
        fmt::format("{} {}", row.name(), fmt::join(settings.begin(), settings.end(), " "));
    if (const auto known = first_jobs_.find(key); known != first_jobs_.end()) {
      return known->second;
    }
    TWIN_TRY(const config::MachineFile machine,
             config::read_machine_file(request_.machine_file, all));
    TWIN_TRY(const std::filesystem::path file, config::find_program(row.program + ".nc"));
    TWIN_TRY(const gcode::ProgramText program, gcode::ProgramText::read(file));
    const std::size_t first = jobs_.size();
    studies::jobs::Job job{.name = row.name(),
                           .program = program,
                           .machine = machine,
                           .feedrate = units::mm_per_s_from_mm_per_min(row.feedrate_mm_per_min),
                           .directory = request_.folder / fmt::format("run_{}", first)};
    jobs_.push_back(job);
    job.keeps_results = false;
    for (int repeat = 1; repeat <= request_.repeats; ++repeat) {
      job.machine.table = with_phases_of_repeat(machine.table, repeat);
      job.directory = request_.folder / fmt::format("run_{}_{}", first, repeat);
      jobs_.push_back(job);
    }
    return first_jobs_[key] = first;
  }

  const std::vector<studies::jobs::Job>& jobs() const noexcept { return jobs_; }

 private:
  const Request& request_;
  std::vector<studies::jobs::Job> jobs_;
  std::map<std::string, std::size_t> first_jobs_;  // by row and settings
};

std::vector<double> values_of(int table, const results::Summary& summary,
                              const config::MachineFile& machine) {
  std::vector<double> values;
  for (const PublishedColumn& column : columns_of(table)) {
    values.push_back(column.ours(summary, machine));
  }
  return values;
}

std::vector<Spread> spreads_of(const std::vector<std::vector<double>>& runs) {
  if (runs.empty()) {
    return {};
  }
  std::vector<Spread> spreads(runs.front().size());
  const auto n = static_cast<double>(runs.size());
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    for (const auto& run : runs) {
      spreads[i].mean += run[i] / n;
    }
    double squares = 0.0;
    for (const auto& run : runs) {
      squares += (run[i] - spreads[i].mean) * (run[i] - spreads[i].mean);
    }
    spreads[i].deviation = runs.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  }
  return spreads;
}

Answer answer(const PublishedRow& row, const Request& request,
              const std::vector<studies::jobs::Job>& jobs,
              const std::vector<results::Summary>& summaries, std::size_t first) {
  Answer answer;
  answer.published = row;
  answer.summary = summaries[first];
  answer.machine = jobs[first].machine;
  answer.folder = jobs[first].directory;
  answer.single = values_of(row.table, answer.summary, answer.machine);
  std::vector<std::vector<double>> runs;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(request.repeats); ++i) {
    runs.push_back(values_of(row.table, summaries[first + i], jobs[first + i].machine));
  }
  answer.repeats = spreads_of(runs);
  return answer;
}

constexpr double kG = 1.2207440846057596;  // g^4 = g + 1

double fraction(double x) { return x - std::floor(x); }

}  // namespace

Expected<Reproduction> reproduce(const Request& request) {
  Plan plan(request);
  const std::vector<PublishedRow>& rows = request.published.rows;
  std::array<std::vector<std::size_t>, 2> first_jobs;  // of each row
  for (std::size_t variant = 0; variant < first_jobs.size(); ++variant) {
    for (const PublishedRow& row : rows) {
      TWIN_TRY(const std::size_t first,
               plan.add(row, variant == 0 ? row.settings : std::vector<std::string>()));
      first_jobs[variant].push_back(first);
    }
  }
  TWIN_TRY(const std::vector<results::Summary> summaries,
           studies::jobs::run_jobs(plan.jobs(), request.running));
  Reproduction result;
  result.source = request.published.source;
  result.machine = plan.jobs().front().machine.name;
  result.repeats = request.repeats;
  result.variants[0].name = "as_published";
  result.variants[0].title = "as published";
  result.variants[1].name = "defaults";
  result.variants[1].title = "the paper's planner with the other defaults of this program";
  for (std::size_t variant = 0; variant < first_jobs.size(); ++variant) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      result.variants[variant].answers.push_back(
          answer(rows[i], request, plan.jobs(), summaries, first_jobs[variant][i]));
    }
  }
  return result;
}

const Answer* find_answer(const Variant& variant, const std::string& program,
                          const std::string& interpolator, double feedrate_mm_per_min) {
  const auto found = std::ranges::find_if(variant.answers, [&](const Answer& answer) {
    const PublishedRow& row = answer.published;
    return is_measured(row.table) && row.program == program && row.interpolator == interpolator &&
           row.feedrate_mm_per_min == feedrate_mm_per_min;
  });
  return found == variant.answers.end() ? nullptr : &*found;
}

hal::mujoco::TableParams with_phases_of_repeat(hal::mujoco::TableParams table, int repeat) {
  double step = 1.0;
  for (hal::mujoco::AxisParams& axis : table.axis) {
    step /= kG;
    axis.encoder.phase = fraction(axis.encoder.phase + repeat * step);
  }
  step /= kG;
  constexpr double kCycle = 2.0 * std::numbers::pi;
  for (hal::mujoco::AxisParams& axis : table.axis) {
    axis.drive.hum_phase = kCycle * fraction(axis.drive.hum_phase / kCycle + repeat * step);
  }
  return table;
}

}  // namespace twin::studies::reproduce
