#include "studies/tune/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "config/find_file.hpp"
#include "core/parallel_for.hpp"
#include "runtime/program_check.hpp"
#include "runtime/run_options.hpp"
#include "session/machine.hpp"
#include "studies/search/minimise.hpp"

namespace twin::studies::tune {
namespace {

/// First standard deviation of the search, of the ranges.
constexpr double kSpread = 0.15;

/// Parameters of the table that are off by 20 % where the result is judged.
constexpr std::array<const char*, 4> kDoubtful{"moving_mass_kg", "coulomb_friction_N",
                                               "viscous_friction_N_s_per_m", "velocity_gain_Hz"};

/// A search: what was tried, and the first error.
class Search {
 public:
  Search(const Task& task, const batch::Store& store, const Options& options)
      : options_(options), evaluator_(task, store, &stop_) {}

  Evaluator& evaluator() { return evaluator_; }
  /// Cost of a point of the unit cube. Called from several threads.
  double cost(std::span<const double> point) {
    if (is_over()) {
      return kNone;
    }
    auto trial = evaluator_.try_at(point);
    const std::lock_guard lock(mutex_);
    if (!trial) {
      note(trial.error());
      return kNone;
    }
    const double cost = trial->cost;
    unstable_ += trial->rows.empty() ? 1 : 0;
    trials_.emplace(trial->values, *std::move(trial));
    least_ = std::min(least_, cost);
    if (options_.progress) {
      options_.progress({options_.trials, std::min(++done_, options_.trials), least_});
    }
    return cost;
  }

  /// Whether the search is to end early.
  bool is_over() {
    if (options_.stop != nullptr && options_.stop->load()) {
      stop_ = true;
    }
    return stop_;
  }
  const std::atomic<bool>* stop() const { return &stop_; }
  Expected<void> outcome() const {
    return error_ ? Expected<void>(tl::unexpected(*error_)) : Expected<void>{};
  }
  /// The trials that were run, by their values.
  std::vector<Trial> take_trials() {
    std::vector<Trial> run;
    for (auto& [values, trial] : trials_) {
      if (!trial.rows.empty()) {
        run.push_back(std::move(trial));
      }
    }
    return run;
  }
  std::size_t unstable() const { return unstable_; }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  void note(const Error& error) {
    if (!error_) {
      error_ = error;
    }
    stop_ = true;
  }

  const Options& options_;
  std::atomic<bool> stop_{false};
  Evaluator evaluator_;
  std::mutex mutex_;  // of what follows
  std::map<std::vector<std::string>, Trial> trials_;
  std::optional<Error> error_;
  std::size_t done_ = 0;
  std::size_t unstable_ = 0;
  double least_ = kNone;
};

/// Checks keys and programs before anything runs. @returns the machine with its own settings
Expected<config::MachineFile> check_task(const Task& task, const Options& options) {
  TWIN_TRY(config::MachineFile machine, session::read_machine({task.machine, task.settings}));
  for (const auto* programs : {&task.programs, &options.further_programs}) {
    for (const std::string& name : *programs) {
      TWIN_TRY(const std::filesystem::path file, config::find_program(name));
      TWIN_TRY(const gcode::ProgramText program, gcode::ProgramText::read(file));
      TWIN_CHECK(runtime::check_program(program, runtime::reader_options(machine, task.feedrate),
                                        machine.limits, options.stop));
    }
  }
  for (const VariedKey& key : task.keys) {
    TWIN_CHECK(number_of(machine, key.key));
    for (const double end : {key.from, key.to}) {
      config::MachineFile changed = machine;
      TWIN_CHECK(config::apply_override(changed, fmt::format("{}={:.9g}", key.key, end)));
    }
  }
  return machine;
}

search::MinimiseOptions search_options(const Task& task, const Options& options,
                                       const config::MachineFile& machine) {
  search::MinimiseOptions how;
  for (const VariedKey& key : task.keys) {
    how.start.push_back(std::clamp(key.place(*number_of(machine, key.key)), 0.0, 1.0));
  }
  how.spread = kSpread;
  how.evaluations = options.trials;
  how.seed = options.seed;
  how.threads = options.workers;
  how.precision = 1e-5;
  return how;
}

/// The parameters of both axes times a factor, as settings.
Expected<std::vector<std::string>> off_by(const config::MachineFile& machine, double factor) {
  std::vector<std::string> settings;
  for (const char* axis : {"x", "y"}) {
    for (const char* name : kDoubtful) {
      const std::string key = fmt::format("table.{}.{}", axis, name);
      TWIN_TRY(const double value, number_of(machine, key));
      settings.push_back(fmt::format("{}={:.9g}", key, factor * value));
    }
  }
  return settings;
}

/// Every program on every table, before and after.
Expected<std::vector<Judgement>> judge(const Task& task, const Options& options,
                                       const config::MachineFile& machine, Search& search,
                                       const std::vector<std::string>& values) {
  TWIN_TRY(const auto up, off_by(machine, 1.2));
  TWIN_TRY(const auto down, off_by(machine, 0.8));
  const std::array<std::pair<const char*, std::vector<std::string>>, 3> tables{
      {{"as it is", {}}, {"20 % up", up}, {"20 % down", down}}};
  std::vector<std::string> programs = task.programs;
  programs.insert(programs.end(), options.further_programs.begin(), options.further_programs.end());
  std::vector<Judgement> judgements;
  std::vector<const std::vector<std::string>*> settings;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    for (const auto& [name, off] : tables) {
      judgements.push_back({programs[i], name, i < task.programs.size(), {}, {}});
      settings.push_back(&off);
    }
  }
  std::vector<std::optional<Error>> errors(judgements.size());
  parallel_for(
      judgements.size(),
      [&](std::size_t i) {
        Judgement& judgement = judgements[i];
        const auto run = [&](const std::vector<std::string>& of, Trial& into) {
          auto trial = search.evaluator().run_values(of, *settings[i], {judgement.program});
          if (trial) {
            into = *std::move(trial);
          } else if (!errors[i]) {
            errors[i] = trial.error();
          }
        };
        if (!search.is_over()) {
          run({}, judgement.before);
          run(values, judgement.after);
        }
      },
      options.workers);
  for (const auto& error : errors) {
    if (error) {
      return tl::unexpected(*error);
    }
  }
  return judgements;
}

/// Whether the best trial is any good.
Expected<void> check_best(const Task& task, const Trial& best, std::size_t trials) {
  if (best.rows.empty() || std::isnan(best.merit.contour_error)) {
    return fail(ErrorCode::kMachine,
                fmt::format("no settings in these ranges have a gain margin of {:g} dB and a phase "
                            "margin of {:g} deg and bring every program to its end, by {} trials; "
                            "try more of them, wider ranges or smaller margins",
                            task.margins.gain_dB, task.margins.phase_deg, trials));
  }
  if (task.aim == Aim::kTime && best.merit.contour_error > task.largest_error) {
    return fail(
        ErrorCode::kMachine,
        fmt::format("no settings keep the contour error of {:g} um, by {} trials; the least "
                    "that was found is {:.4g} um",
                    task.largest_error, trials, best.merit.contour_error));
  }
  return {};
}

tl::unexpected<Error> interrupted() {
  return fail(ErrorCode::kInterrupted,
              "interrupted: the same command goes on where the store ends");
}

}  // namespace

Expected<Tuning> tune(const Task& task, const batch::Store& store, const Options& options) {
  TWIN_TRY(const config::MachineFile machine, check_task(task, options));
  Search search(task, store, options);
  Tuning tuning;
  TWIN_TRY(tuning.before, search.evaluator().run_values({}, {}, task.programs));
  search::MinimiseOptions how = search_options(task, options, machine);
  how.stop = search.stop();
  const search::Minimum minimum =
      search::minimise([&](std::span<const double> point) { return search.cost(point); }, how);
  TWIN_CHECK(search.outcome());
  if (search.is_over()) {
    return interrupted();
  }
  TWIN_TRY(tuning.best, search.evaluator().try_at(minimum.x));
  TWIN_CHECK(check_best(task, tuning.best, minimum.evaluations));
  for (const VariedKey& key : task.keys) {
    tuning.keys.push_back(key.key);
  }
  TWIN_TRY(tuning.judgements, judge(task, options, machine, search, tuning.best.values));
  if (search.is_over()) {
    return interrupted();
  }
  tuning.machine = tuning.best.rows.front().job.machine;
  tuning.trials = search.take_trials();
  tuning.asked = minimum.evaluations;
  tuning.unstable = search.unstable();
  tuning.computed = search.evaluator().runs();
  tuning.found = search.evaluator().found();
  return tuning;
}

}  // namespace twin::studies::tune
