#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "config/find_file.hpp"
#include "session/pictures.hpp"

namespace twin::cli {
namespace {

Expected<void> render_command(const Options& options) {
  TWIN_TRY(const session::TraceOrigin origin, session::read_origin(options.out));
  if (options.video && origin.kind == session::TraceKind::kPlan) {
    return fail(ErrorCode::kUsage,
                "--video needs the trace of a run; this one is of a plan, without a machine");
  }
  TWIN_TRY(const config::MachineFile machine, read_machine(options));
  if (!options.no_plots) {
    Progress progress("plots", options.quiet);
    progress.show(0.0);
    const auto program = config::find_program(origin.program);
    TWIN_CHECK(session::draw_figures(
        {options.out, program.value_or(std::filesystem::path()), origin.program, origin.kind}));
  }
  if (options.video) {
    Progress progress("video", options.quiet);
    TWIN_CHECK(session::render_video(
        {options.out, machine.table.model, origin.program, options.camera, progress.callback()}));
  }
  return {};
}

}  // namespace

Command add_render(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app =
      context.app.add_subcommand("render", "Plots and video again, from the trace in a folder");
  app->add_option("directory", options.out, "Folder of an earlier run")
      ->required()
      ->type_name("DIR");
  app->add_option("--machine", options.machine, "Machine file whose model the video shows")
      ->type_name("FILE.toml")
      ->capture_default_str();
  app->add_flag("--no-plots", options.no_plots, "Draw no figures");
  app->add_flag("--quiet", options.quiet, "Print errors only");
  add_video_options(*app, options);
  return {app, [&options] { return render_command(options); }};
}

}  // namespace twin::cli
