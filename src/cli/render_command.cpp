#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/results.hpp"
#include "config/find_file.hpp"

namespace twin::cli {
namespace {

/// What summary.json says of the trace beside it.
struct TraceOrigin {
  std::string program;
  bool has_machine = true;
};

Expected<TraceOrigin> read_origin(const std::filesystem::path& folder) {
  const auto file = folder / "summary.json";
  std::ifstream in(file);
  if (!in) {
    return tl::unexpected(Error{ErrorCode::kFile, "cannot be read; is this the folder of a run?",
                                file.string(), 0, 0});
  }
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("program") || !json["program"].is_string()) {
    return tl::unexpected(
        Error{ErrorCode::kFile, "is not the summary of a run", file.string(), 0, 0});
  }
  return TraceOrigin{json["program"].get<std::string>(), json.contains("machining_time_s")};
}

Expected<void> render_command(const Options& options) {
  auto origin = read_origin(options.out);
  if (!origin) {
    return tl::unexpected(origin.error());
  }
  if (options.video && !origin->has_machine) {
    return fail(ErrorCode::kUsage,
                "--video needs the trace of a run; this one is of a plan, without a machine");
  }
  auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  if (!options.no_plots) {
    const auto program = config::find_program(origin->program);
    if (auto drawn = write_plots(options.out, program.value_or(std::filesystem::path()),
                                 origin->program, !origin->has_machine, options.quiet);
        !drawn) {
      return drawn;
    }
  }
  if (options.video) {
    return write_video(options.out, machine->table.model, origin->program, options);
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
