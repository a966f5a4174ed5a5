#include <fmt/core.h>

#include "cli/commands.hpp"
#include "config/find_file.hpp"
#include "session/machine.hpp"
#include "session/results.hpp"
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

}  // namespace

Expected<void> execute(const ReproduceArguments& arguments, const Environment& environment) {
  const ResultArguments& results = arguments.results;
  studies::reproduce::Request request;
  TWIN_TRY(request.published, studies::reproduce::published());
  TWIN_TRY(request.machine_file, config::find_machine(arguments.machine.file));
  const std::filesystem::path out = session::result_folder(results.folder, "reproduce");
  TWIN_TRY(const auto workshop, pictures::Workshop::open(out));
  request.settings = arguments.machine.settings;
  request.repeats = arguments.repeats;
  request.folder = workshop.folder();
  request.running.make_machine = [](const config::MachineFile& file) {
    return *session::make_simulated_machine("mujoco", file);
  };
  request.running.stop = &environment.stop;
  Expected<studies::reproduce::Reproduction> reproduction;
  {
    Progress progress("machining", results.verbosity);
    request.running.progress = progress.callback();
    reproduction = studies::reproduce::reproduce(request);
  }
  if (!reproduction) {
    return tl::unexpected(reproduction.error());
  }
  {
    Progress progress("plots", results.has_plots ? results.verbosity : Verbosity::kQuiet);
    progress.show(0.0);
    TWIN_CHECK(
        write_results(*reproduction, workshop,
                      results.has_plots ? pictures::Drawing::kDrawn : pictures::Drawing::kLeftOut));
  }
  if (results.verbosity == Verbosity::kNormal) {
    print(*reproduction);
    fmt::print("tables and figures: {}\n", (out / "index.html").string());
  }
  return {};
}

}  // namespace twin::cli
