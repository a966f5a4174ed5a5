#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/progress.hpp"
#include "config/find_file.hpp"
#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction_files.hpp"
#include "studies/reproduce/reproduction_tables.hpp"

namespace twin::cli {
namespace {

void print(const studies::reproduce::Reproduction& reproduction) {
  fmt::print("{}\nA ratio is ours / published; ! marks one that is more than 30 % off.\n\n",
             reproduction.source);
  for (int table = studies::reproduce::kFirstTable; table <= studies::reproduce::kLastTable;
       ++table) {
    fmt::print("{}\n", to_text(grid_of_table(reproduction, table)));
  }
  fmt::print("{}\n{}\n\n", to_text(grid_of_counts(reproduction)), unreached(reproduction));
}

Expected<void> reproduce_command(const Options& options, const std::atomic<bool>& stop) {
  studies::reproduce::Request request;
  auto published = studies::reproduce::published();
  auto machine = config::find_machine(options.machine);
  if (!published || !machine) {
    return tl::unexpected(!published ? published.error() : machine.error());
  }
  const std::filesystem::path out = options.out.empty() ? "renders/reproduce" : options.out;
  auto workshop = pictures::Workshop::open(out);
  if (!workshop) {
    return tl::unexpected(workshop.error());
  }
  request.published = *published;
  request.machine_file = *machine;
  request.settings = options.settings;
  request.repeats = options.repeats;
  request.folder = workshop->folder();
  request.running.make_machine = [](const config::MachineFile& file) {
    return make_machine("mujoco", file);
  };
  request.running.stop = &stop;
  Expected<studies::reproduce::Reproduction> reproduction;
  {
    Progress progress("machining", options.quiet);
    request.running.progress = progress.callback();
    reproduction = studies::reproduce::reproduce(request);
  }
  if (!reproduction) {
    return tl::unexpected(reproduction.error());
  }
  {
    Progress progress("plots", options.quiet || options.no_plots);
    progress.show(0.0);
    TWIN_CHECK(
        write_results(*reproduction, *workshop,
                      options.no_plots ? pictures::Drawing::kLeftOut : pictures::Drawing::kDrawn));
  }
  if (!options.quiet) {
    print(*reproduction);
    fmt::print("tables and figures: {}\n", (out / "index.html").string());
  }
  return {};
}

}  // namespace

Command add_reproduce(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "reproduce", "Tables 1 to 5 and Figs. 12 to 19 of Wang and Yau's paper beside ours");
  add_machine_options(*app, options);
  app->add_option("--repeats", options.repeats, "Runs a row with other encoder and hum phases")
      ->check(CLI::Range(0, 1000))
      ->type_name("N")
      ->capture_default_str();
  add_result_options(*app, options, "reproduce");
  return {app, [&options, &stop = context.stop] { return reproduce_command(options, stop); }};
}

}  // namespace twin::cli
