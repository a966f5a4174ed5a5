#include "session/axis_move.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/atomic_file.hpp"
#include "core/units.hpp"
#include "session/results.hpp"

namespace twin::session {

Expected<runtime::RunResult> make_axis_move(const AxisMove& move,
                                            const config::MachineFile& machine, hal::Machine& hal,
                                            const std::atomic<bool>& stop) {
  Request request;
  request.folder = result_folder(move.folder, "rig_" + move.name);
  const std::filesystem::path program = request.folder / (move.name + ".nc");
  request.machine = machine;
  request.hal = &hal;
  request.until = move.until;
  request.command = move.command;
  request.trace = move.trace;
  const std::string text =
      fmt::format("G01 {:c}{:.6f} F{:.6f}\nM30\n", move.axis == hal::kX ? 'X' : 'Y', move.distance,
                  units::mm_per_min_from_mm_per_s(move.feedrate));
  TWIN_CHECK(prepare_output_file(program));
  TWIN_CHECK(write_whole_file(program, text));
  request.program = gcode::ProgramText::from_text(text, program);
  TWIN_TRY(Session session, Session::open(std::move(request)));
  TWIN_TRY(runtime::RunResult result, session.run({.stop = &stop}));
  if (auto shown = session.write_report(); !shown && !result.failure) {
    return tl::unexpected(shown.error());
  }
  return result;
}

}  // namespace twin::session
