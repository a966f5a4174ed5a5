#include "cli/rig_motion.hpp"

#include <fmt/format.h>

#include "cli/results.hpp"
#include "core/atomic_file.hpp"
#include "core/units.hpp"

namespace twin::cli {

Expected<runtime::RunResult> make_axis_move(const AxisMove& move, const Options& options,
                                            const config::MachineFile& machine, hal::Machine& hal,
                                            const std::atomic<bool>& stop) {
  runtime::RunRequest request;
  request.directory = result_folder(options, "rig_" + move.name);
  request.program = request.directory / (move.name + ".nc");
  request.machine = machine;
  request.hal = &hal;
  request.is_wall_clock = options.realtime || hal.info().keeps_own_time;
  request.stop = &stop;
  request.until = move.until;
  const std::string text =
      fmt::format("G01 {:c}{:.6f} F{:.6f}\nM30\n", move.axis == 'x' ? 'X' : 'Y', move.distance,
                  units::mm_per_min_from_mm_per_s(move.feedrate));
  auto written = prepare_output_file(request.program.file).and_then([&] {
    return write_whole_file(request.program.file, text);
  });
  if (!written) {
    return tl::unexpected(written.error());
  }
  auto result = runtime::run_program(request);
  if (!result) {
    return result;
  }
  if (auto saved = write_summary(request.directory, *result); !saved) {
    return tl::unexpected(saved.error());
  }
  if (!result->failure) {
    remove_stale_results(request.directory);
  }
  return result;
}

}  // namespace twin::cli
