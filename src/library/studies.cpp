#include "twin/studies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>

#include "library/inside.hpp"
#include "session/machine.hpp"
#include "studies/circular/circle_test.hpp"
#include "studies/convert/checked_conversion.hpp"
#include "studies/convert/dialect.hpp"

namespace twin {

Circle circle(const Settings& settings, const CircleOptions& options) {
  if (options.folder.empty()) {
    throw Failure({ErrorCode::kUsage, "the circular test needs a folder for its traces", {}, 0, 0});
  }
  studies::circular::CircleTest test;
  test.machine = Inside::of(settings);
  test.make_machine = [](const config::MachineFile& file, const std::string&) {
    return session::make_simulated_machine("mujoco", file);
  };
  test.radius = options.radius;
  test.feedrate = options.feedrate;
  test.folder = options.folder;
  const std::atomic<bool> never{false};
  const auto run = value_of(studies::circular::run_circle_test(
      test, {}, options.stop != nullptr ? *options.stop : never));
  return {studies::circular::to_table(run.report), studies::circular::to_json(run.report)};
}

Converted convert(const Program& program, const Settings& settings, const std::string& dialect) {
  if (studies::convert::make_dialect(dialect) == nullptr) {
    throw Failure({ErrorCode::kUsage,
                   fmt::format("unknown dialect {} (there are {})", dialect,
                               fmt::join(studies::convert::dialect_names(), ", ")),
                   {},
                   0,
                   0});
  }
  const auto& data = Inside::of(program);
  const config::MachineFile& machine = Inside::of(settings);
  studies::convert::Job job{data.source, {}, machine.path, machine.planning, machine.limits};
  job.reading.feedrate = data.feedrate;
  const auto checked = value_of(studies::convert::convert_and_check(job, dialect));
  return {checked.conversion.text, studies::convert::to_table(job, dialect, checked)};
}

}  // namespace twin
