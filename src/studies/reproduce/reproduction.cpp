#include "studies/reproduce/reproduction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "config/find_file.hpp"
#include "core/units.hpp"
#include "studies/reproduce/figure_kinds.hpp"
#include "studies/reproduce/phases.hpp"

namespace twin::studies::reproduce {
namespace {

/// The runs that are needed, each once.
class Plan {
 public:
  explicit Plan(const Request& request) : request_(request) {}

  /// The place of a row's single run among the jobs; its repeats follow it.
  Expected<std::size_t> add(const PublishedRow& row, const std::vector<std::string>& settings) {
    std::vector<std::string> all = request_.settings;
    all.emplace_back("planning.planner=paper");
    all.push_back("path.curves=" + row.interpolator);
    all.insert(all.end(), settings.begin(), settings.end());
    const std::string key =
        fmt::format("{} {}", row.name(), fmt::join(settings.begin(), settings.end(), " "));
    if (const auto known = places_.find(key); known != places_.end()) {
      return known->second;
    }
    auto machine = config::read_machine_file(request_.machine_file, all);
    if (!machine) {
      return tl::unexpected(std::move(machine.error()));
    }
    auto program = config::find_program(row.program + ".nc");
    if (!program) {
      return tl::unexpected(std::move(program.error()));
    }
    const std::size_t place = jobs_.size();
    studies::Job job{row.name(), *program, *machine,
                     units::mm_per_s_from_mm_per_min(row.feedrate_mm_per_min),
                     request_.folder / fmt::format("run_{}", place)};
    jobs_.push_back(job);
    job.keeps_results = false;
    for (int repeat = 1; repeat <= request_.repeats; ++repeat) {
      job.machine.table = with_phases_of_repeat(machine->table, repeat);
      job.directory = request_.folder / fmt::format("run_{}_{}", place, repeat);
      jobs_.push_back(job);
    }
    return places_[key] = place;
  }

  const std::vector<studies::Job>& jobs() const noexcept { return jobs_; }

 private:
  const Request& request_;
  std::vector<studies::Job> jobs_;
  std::map<std::string, std::size_t> places_;
};

std::vector<double> figures_of(int table, const results::Summary& summary,
                               const config::MachineFile& machine) {
  std::vector<double> figures;
  for (const FigureKind& kind : columns_of(table)) {
    figures.push_back(kind.ours(summary, machine));
  }
  return figures;
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
              const std::vector<studies::Job>& jobs, const std::vector<results::Summary>& summaries,
              std::size_t place) {
  Answer answer;
  answer.published = row;
  answer.summary = summaries[place];
  answer.machine = jobs[place].machine;
  answer.folder = jobs[place].directory;
  answer.single = figures_of(row.table, answer.summary, answer.machine);
  std::vector<std::vector<double>> runs;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(request.repeats); ++i) {
    runs.push_back(figures_of(row.table, summaries[place + i], jobs[place + i].machine));
  }
  answer.repeats = spreads_of(runs);
  return answer;
}

}  // namespace

Expected<Reproduction> reproduce(const Request& request) {
  Plan plan(request);
  const std::vector<PublishedRow>& rows = request.published.rows;
  std::array<std::vector<std::size_t>, 2> places;
  for (std::size_t variant = 0; variant < places.size(); ++variant) {
    for (const PublishedRow& row : rows) {
      auto place = plan.add(row, variant == 0 ? row.settings : std::vector<std::string>());
      if (!place) {
        return tl::unexpected(std::move(place.error()));
      }
      places[variant].push_back(*place);
    }
  }
  auto summaries = studies::run_jobs(plan.jobs(), request.running);
  if (!summaries) {
    return tl::unexpected(std::move(summaries.error()));
  }
  Reproduction result;
  result.source = request.published.source;
  result.machine = plan.jobs().front().machine.name;
  result.repeats = request.repeats;
  result.variants[0].name = "as_published";
  result.variants[0].title = "as published";
  result.variants[1].name = "defaults";
  result.variants[1].title = "defaults of this program";
  for (std::size_t variant = 0; variant < places.size(); ++variant) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      result.variants[variant].answers.push_back(
          answer(rows[i], request, plan.jobs(), *summaries, places[variant][i]));
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

}  // namespace twin::studies::reproduce
