#include "studies/predict/fastest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.hpp"
#include "results/metrics/block_distance.hpp"
#include "studies/predict/feed_program.hpp"

namespace twin::studies::predict {
namespace {

using compensate::ContourPath;

constexpr double kSlowest = 1.0 / 64.0;  // of the largest feedrate, the slowest that is tried
constexpr double kStepBack = 0.93;       // of a feedrate that does not hold
constexpr double kShortest = 5.0;        // stretch [mm]
constexpr double kMostChange = 1.35;     // of a feedrate in a round
constexpr double kAim = 0.98;            // of the tolerance that a stretch aims at
constexpr double kBelowFailed = 0.99;    // of a feedrate that was too fast for its stretch
constexpr double kSharpness = 0.7;       // exponent of room in the change of a feedrate

/// A plan and the errors of possible machines on it.
struct Trial {
  ContourPath path;
  PossibleErrors errors;
  double time = 0.0;   // [s]
  double error = 0.0;  // that the share of machines stays within [mm]
};

/// Feedrates of stretches.
struct Schedule {
  std::vector<std::size_t> stretch;  // of each block
  std::vector<double> feeds;         // of each stretch [mm/s]
  std::vector<double> most;          // that they may be: less than what was too fast [mm/s]
};

/// The search for one program.
class Search {
 public:
  Search(const gcode::ProgramText& program, const config::MachineFile& machine,
         const FastestOptions& options, const Uncertainty& uncertainty)
      : program_(program),
        machine_(machine),
        options_(options),
        uncertainty_(uncertainty),
        searching_(options.tolerance, options.share),
        holding_(options.tolerance, options.share) {}

  Expected<Fastest> run();

 private:
  Expected<Trial> tried(const gcode::ProgramText& program, const config::MachineFile& machine,
                        const std::optional<double>& feedrate, Question* question) const;
  Expected<CutPlan> verified(const Trial& trial, double feedrate) const;
  /// The fastest trial of plans that get slower with a factor from 1 down; none keeps it: nothing.
  template <class Make>
  Expected<std::optional<std::pair<double, Trial>>> fastest_of(const Make& make);
  void change(std::span<const double> errors, Schedule& schedule) const;
  Expected<std::optional<Trial>> tried_schedule(const std::vector<gcode::Block>& blocks,
                                                const Schedule& schedule, Fastest& found);
  Expected<std::string> text_of(std::span<const gcode::Block> blocks,
                                std::span<const std::size_t> stretch,
                                std::span<const double> feeds) const;
  Expected<void> find_stretches(const Trial& whole, double feedrate, Fastest& found);
  Expected<void> find_paper(Fastest& found);
  void tell(const std::string& what) const {
    if (options_.tell) {
      options_.tell(what);
    }
  }
  bool keeps(const Trial& trial) const { return trial.error <= options_.tolerance; }
  Expected<bool> holds(const Trial& trial);

  const gcode::ProgramText& program_;
  const config::MachineFile& machine_;
  const FastestOptions& options_;
  const Uncertainty& uncertainty_;
  Question searching_;                   // of the machines of the search
  Question holding_;                     // of those that it has not seen
  std::optional<Trial> schedule_trial_;  // the fastest that keeps the tolerance
};

Expected<Trial> Search::tried(const gcode::ProgramText& program, const config::MachineFile& machine,
                              const std::optional<double>& feedrate, Question* question) const {
  Trial trial;
  TWIN_TRY(trial.path, ContourPath::plan(program, machine, feedrate));
  const std::vector<std::size_t> blocks = trial.path.blocks_of_periods();
  TWIN_TRY(trial.errors, possible_errors(trial.path, uncertainty_, {}, blocks,
                                         {.machines = options_.machines,
                                          .seed = options_.seed,
                                          .stop = options_.stop,
                                          .progress = {},
                                          .question = question}));
  trial.time = trial.path.time(machine.period);
  trial.error = quantile(trial.errors.largest, options_.share);
  return trial;
}

/// Whether as many machines that the search has not seen keep the tolerance as well.
Expected<bool> Search::holds(const Trial& trial) {
  TWIN_TRY(const PossibleErrors errors, possible_errors(trial.path, uncertainty_, {}, {},
                                                        {.machines = options_.verifying,
                                                         .seed = options_.seed + 2,
                                                         .stop = options_.stop,
                                                         .progress = {},
                                                         .question = &holding_}));
  return quantile(errors.largest, options_.share) <= options_.tolerance;
}

Expected<CutPlan> Search::verified(const Trial& trial, double feedrate) const {
  TWIN_TRY(const PossibleErrors errors, possible_errors(trial.path, uncertainty_, {}, {},
                                                        {.machines = options_.verifying,
                                                         .seed = options_.seed + 1,
                                                         .stop = options_.stop,
                                                         .progress = {},
                                                         .question = nullptr}));
  return CutPlan{trial.time, feedrate, predict(errors.largest, options_.tolerance)};
}

template <class Make>
Expected<std::optional<std::pair<double, Trial>>> Search::fastest_of(const Make& make) {
  using Found = std::optional<std::pair<double, Trial>>;
  double high = 1.0;
  TWIN_TRY(Trial trial, make(high));
  double low = high;
  Found found;
  if (keeps(trial)) {
    found.emplace(high, std::move(trial));
  }
  while (!found && low > kSlowest) {
    high = low;
    low *= 0.5;
    TWIN_TRY(Trial slower, make(low));
    if (keeps(slower)) {
      found.emplace(low, std::move(slower));
    }
  }
  for (int i = 0; found && low < high && i < options_.halvings; ++i) {
    const double middle = std::sqrt(low * high);
    TWIN_TRY(Trial between, make(middle));
    if (keeps(between)) {
      low = middle;
      found.emplace(middle, std::move(between));
    } else {
      high = middle;
    }
  }
  while (found) {
    TWIN_TRY(const bool does, holds(found->second));
    if (does) {
      break;
    }
    const double slower = kStepBack * found->first;
    found.reset();
    if (slower >= kSlowest) {
      TWIN_TRY(Trial again, make(slower));
      found.emplace(slower, std::move(again));
    }
  }
  return found;
}

/// Groups blocks that feed to stretches of some length. @returns the stretch of each block
std::vector<std::size_t> stretches_of(std::span<const gcode::Block> blocks) {
  std::vector<std::size_t> stretch(blocks.size(), 0);
  std::size_t now = 0;
  double length = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (length >= kShortest) {
      ++now;
      length = 0.0;
    }
    stretch[i] = now;
    length += results::block_length(blocks[i], results::View::kSpace);
  }
  return stretch;
}

/// The error of each stretch that a share of the machines stays within.
std::vector<double> errors_of_stretches(const PossibleErrors& errors,
                                        std::span<const std::size_t> stretch, double share) {
  const std::size_t count = stretch.empty() ? 0 : stretch.back() + 1;
  std::vector<std::vector<double>> worst(count, std::vector<double>(errors.on_stretch.size(), 0.0));
  for (std::size_t m = 0; m < errors.on_stretch.size(); ++m) {
    const std::vector<double>& of_blocks = errors.on_stretch[m];
    for (std::size_t b = 0; b < std::min(stretch.size(), of_blocks.size()); ++b) {
      worst[stretch[b]][m] = std::max(worst[stretch[b]][m], of_blocks[b]);
    }
  }
  std::vector<double> result(count);
  std::ranges::transform(worst, result.begin(), [share](const std::vector<double>& of_machines) {
    return quantile(of_machines, share);
  });
  return result;
}

/// Raises feedrates of stretches whose error leaves room, and lowers the others, for good.
void Search::change(std::span<const double> errors, Schedule& schedule) const {
  const double aim = kAim * options_.tolerance;
  for (std::size_t s = 0; s < schedule.feeds.size(); ++s) {
    // An error is made before the place where it shows, so the stretch before shares it.
    const double here = std::max(errors[s], s + 1 < errors.size() ? 0.9 * errors[s + 1] : 0.0);
    const double room = std::pow(aim / std::max(here, 1e-6), kSharpness);
    double& feed = schedule.feeds[s];
    if (room < 1.0) {
      schedule.most[s] = std::min(schedule.most[s], kBelowFailed * feed);
    }
    feed = std::clamp(feed * std::clamp(room, 1.0 / kMostChange, kMostChange),
                      kSlowest * machine_.limits.feedrate, schedule.most[s]);
  }
}

Expected<std::string> Search::text_of(std::span<const gcode::Block> blocks,
                                      std::span<const std::size_t> stretch,
                                      std::span<const double> feeds) const {
  std::vector<double> of_blocks(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    of_blocks[b] = feeds[stretch[b]];
  }
  return feed_program(
      blocks, of_blocks, machine_,
      fmt::format("{}, contour error within {:g} um", program_.file().filename().string(),
                  units::um_from_mm(options_.tolerance)));
}

std::vector<FeedStretch> schedule_of(std::span<const gcode::Block> blocks,
                                     std::span<const std::size_t> stretch,
                                     std::span<const double> feeds) {
  std::vector<FeedStretch> schedule;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (schedule.size() <= stretch[b]) {
      schedule.push_back({blocks[b].line, blocks[b].line, feeds[stretch[b]]});
    }
    schedule.back().last_line = blocks[b].line;
  }
  return schedule;
}

/// Tries a schedule. @returns its trial; null: it cannot be written
Expected<std::optional<Trial>> Search::tried_schedule(const std::vector<gcode::Block>& blocks,
                                                      const Schedule& schedule, Fastest& found) {
  auto text = text_of(blocks, schedule.stretch, schedule.feeds);
  if (!text) {
    found.why_no_stretches = to_string(text.error());
    return std::optional<Trial>();
  }
  TWIN_TRY(Trial trial,
           tried(gcode::ProgramText::from_text(*text, program_.file()), machine_, {}, nullptr));
  const bool is_faster = keeps(trial) && (!schedule_trial_ || trial.time < schedule_trial_->time);
  if (is_faster) {
    TWIN_TRY(const bool does, holds(trial));
    if (does) {
      found.program = *std::move(text);
      found.schedule = schedule_of(blocks, schedule.stretch, schedule.feeds);
      schedule_trial_ = trial;
    }
  }
  return std::optional<Trial>(std::move(trial));
}

Expected<void> Search::find_stretches(const Trial& whole, double feedrate, Fastest& found) {
  const std::vector<gcode::Block>& blocks = whole.path.blocks();
  Schedule schedule{.stretch = stretches_of(blocks), .feeds = {}, .most = {}};
  const std::size_t count = schedule.stretch.empty() ? 0 : schedule.stretch.back() + 1;
  schedule.feeds.assign(count, feedrate);
  schedule.most.assign(count, machine_.limits.feedrate);
  std::optional<Trial> last(whole);
  for (int round = 0; round < options_.rounds; ++round) {
    tell(fmt::format("feedrates of {} stretches, round {} of {}", count, round + 1,
                     options_.rounds));
    change(errors_of_stretches(last->errors, schedule.stretch, 0.5 * (1.0 + options_.share)),
           schedule);
    TWIN_TRY(last, tried_schedule(blocks, schedule, found));
    if (!last) {
      return {};
    }
  }
  // Between one feedrate for all, which keeps the tolerance, and what was found in the end.
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < options_.halvings; ++i) {
    const double share = 0.5 * (low + high);
    Schedule between = schedule;
    for (double& feed : between.feeds) {
      feed = feedrate * std::pow(feed / feedrate, share);
    }
    TWIN_TRY(last, tried_schedule(blocks, between, found));
    if (!last) {
      break;
    }
    (keeps(*last) ? low : high) = share;
  }
  if (schedule_trial_) {
    TWIN_TRY(found.stretches, verified(*schedule_trial_, 0.0));
  }
  return {};
}

Expected<void> Search::find_paper(Fastest& found) {
  const auto planned = [&](double eps, double feedrate) {
    config::MachineFile paper = machine_;
    paper.path.planner = Planner::kPaper;
    paper.planning.corner_error = paper.planning.circular_error = eps;
    return tried(program_, paper, feedrate, &searching_);
  };
  tell("the paper's servo model");
  const double largest = machine_.limits.feedrate;
  TWIN_TRY(const Trial told, planned(options_.tolerance, largest));
  TWIN_TRY(found.paper_told, verified(told, largest));
  TWIN_TRY(const auto by_feedrate,
           fastest_of([&](double share) { return planned(options_.tolerance, share * largest); }));
  TWIN_TRY(const auto by_model,
           fastest_of([&](double share) { return planned(share * options_.tolerance, largest); }));
  if (by_feedrate) {
    TWIN_TRY(found.paper, verified(by_feedrate->second, by_feedrate->first * largest));
  }
  if (by_model && (!found.paper || by_model->second.time < found.paper->time)) {
    TWIN_TRY(found.paper, verified(by_model->second, largest));
  }
  return {};
}

Expected<Fastest> Search::run() {
  Fastest found;
  tell("one feedrate for the program");
  const double largest = machine_.limits.feedrate;
  TWIN_TRY(const auto whole, fastest_of([&](double share) {
             return tried(program_, machine_, share * largest, &searching_);
           }));
  if (whole) {
    TWIN_TRY(found.whole, verified(whole->second, whole->first * largest));
    TWIN_CHECK(find_stretches(whole->second, whole->first * largest, found));
  }
  TWIN_CHECK(find_paper(found));
  return found;
}

std::string line_of(const std::string& name, const std::optional<CutPlan>& plan) {
  if (!plan) {
    return fmt::format("  {:<34} none keeps the tolerance\n", name);
  }
  const std::string feedrate =
      plan->feedrate > 0.0 ? fmt::format("{:.0f}", units::mm_per_min_from_mm_per_s(plan->feedrate))
                           : "scheduled";
  return fmt::format("  {:<34} {:>9} {:>9.3f} {:>11.2f} {:>8.3f} ({:.3f} to {:.3f})\n", name,
                     feedrate, plan->time, units::um_from_mm(plan->verified.p95),
                     plan->verified.probability(), plan->verified.low, plan->verified.high);
}

}  // namespace

Expected<Fastest> fastest(const gcode::ProgramText& program, const config::MachineFile& machine,
                          const FastestOptions& options) {
  TWIN_TRY(const Uncertainty uncertainty, Uncertainty::of(machine));
  return Search(program, machine, options, uncertainty).run();
}

std::string to_table(const Fastest& fastest, const FastestOptions& options) {
  std::string text = fmt::format(
      "contour error within {:g} um on {:g} % of possible machines; verified on {} others\n"
      "  {:<34} {:>9} {:>9} {:>11} {:>8}\n",
      units::um_from_mm(options.tolerance), 100.0 * options.share, options.verifying, "",
      "F mm/min", "time s", "95 % um", "kept");
  text += line_of("one feedrate", fastest.whole);
  if (fastest.why_no_stretches.empty()) {
    text += line_of("a feedrate for each stretch", fastest.stretches);
  } else {
    text += fmt::format("  no schedule: {}\n", fastest.why_no_stretches);
  }
  text += line_of("paper's servo model, told this", fastest.paper_told);
  text += line_of("paper's servo model, that keeps it", fastest.paper);
  const CutPlan* const best = fastest.stretches ? &*fastest.stretches
                              : fastest.whole   ? &*fastest.whole
                                                : nullptr;
  if (best != nullptr && fastest.paper) {
    text += fmt::format("  time gained at equal error: {:.1f} %\n",
                        100.0 * (1.0 - best->time / fastest.paper->time));
  }
  return text;
}

}  // namespace twin::studies::predict
