#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "config/find_file.hpp"
#include "session/pictures.hpp"

namespace twin::cli {

Expected<void> execute(const RenderArguments& arguments, const Environment&) {
  TWIN_TRY(const session::TraceOrigin origin, session::read_origin(arguments.folder));
  if (arguments.video.is_wanted && origin.kind == session::TraceKind::kPlan) {
    return fail(ErrorCode::kUsage,
                "--video needs the trace of a run; this one is of a plan, without a machine");
  }
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  if (arguments.has_plots) {
    Progress progress("plots", arguments.verbosity);
    progress.show(0.0);
    const auto program = config::find_program(origin.program);
    TWIN_CHECK(session::draw_figures({arguments.folder, program.value_or(std::filesystem::path()),
                                      origin.program, origin.kind}));
  }
  if (arguments.video.is_wanted) {
    Progress progress("video", arguments.verbosity);
    TWIN_CHECK(session::render_video({arguments.folder, machine.table.model, origin.program,
                                      arguments.video.camera, progress.callback()}));
  }
  return {};
}

}  // namespace twin::cli
