#include "twin/tune.hpp"

#include <filesystem>

#include "library/inside.hpp"
#include "session/machine.hpp"
#include "studies/tune/tune.hpp"
#include "studies/tune/tune_report.hpp"

namespace twin {

Tuned tune(const TuneOptions& options) {
  namespace inner = studies::tune;
  if (options.programs.empty() || options.folder.empty()) {
    throw Failure({ErrorCode::kUsage, "tuning needs a program and a folder", {}, 0, 0});
  }
  inner::Task task;
  task.programs = options.programs;
  task.machine = options.machine;
  task.settings = options.settings;
  task.feedrate = options.feedrate;
  task.aim = options.is_for_time ? inner::Aim::kTime : inner::Aim::kContourError;
  task.largest_error = options.largest_error;
  task.margins = {.gain_dB = options.gain_margin_dB, .phase_deg = options.phase_margin_deg};
  for (const std::string& range : options.ranges) {
    task.keys.push_back(value_of(inner::parse_varied_key(range)));
  }
  if (task.keys.empty()) {
    task.keys = inner::usual_keys(
        value_of(session::read_machine({options.machine, options.settings})), task.aim);
  }
  const std::filesystem::path folder = options.folder;
  const auto store = value_of(studies::batch::Store::open(
      options.store.empty() ? folder / "store" : std::filesystem::path(options.store)));
  const inner::Tuning found = value_of(inner::tune(task, store,
                                                   {.trials = options.trials,
                                                    .seed = options.seed,
                                                    .workers = options.workers,
                                                    .further_programs = options.further_programs,
                                                    .stop = options.stop}));
  check(inner::write_tuning(task, found, folder));
  return {inner::to_table(task, found), inner::to_json(task, found),
          (folder / "best.toml").string()};
}

}  // namespace twin
