#include "cli/compare_linuxcnc.hpp"

#include <utility>

#include "cli/machines.hpp"
#include "core/atomic_file.hpp"
#include "session/results.hpp"
#include "studies/linuxcnc/controllers.hpp"

namespace twin::cli {

Expected<void> compare_with_linuxcnc(const CompareArguments& arguments,
                                     const Environment& environment) {
  if (arguments.feedrate) {
    return fail(
        ErrorCode::kUsage,
        "--feedrate-mm-per-min and --with linuxcnc do not go together: LinuxCNC goes by the "
        "program's F words");
  }
  const Verbosity verbosity = arguments.results.verbosity;
  studies::linuxcnc::ContestRequest request;
  TWIN_TRY(request.machine, read_machine(arguments.machine, verbosity));
  for (const std::string& name : arguments.programs) {
    TWIN_TRY(auto program, read_program(name, arguments.machine, environment.stop));
    request.programs.push_back(std::move(program));
  }
  request.folder = session::result_folder(arguments.results.folder, "controllers");
  TWIN_CHECK(session::prepare_output_file(request.folder / "controllers.html"));
  request.command = environment.command_line;
  request.stop = &environment.stop;
  Expected<std::vector<studies::linuxcnc::ProgramRow>> rows;
  {
    Progress progress("comparing", verbosity);
    request.progress = progress.callback();
    rows = studies::linuxcnc::compare_controllers(request);
  }
  if (!rows) {
    return tl::unexpected(rows.error());
  }
  const TextTable table = studies::linuxcnc::table_of(*rows, request.machine.path.chord_error);
  TWIN_CHECK(write_whole_file(request.folder / "controllers.md", to_markdown(table)));
  TWIN_TRY(const auto page, studies::linuxcnc::write_pages(request, *rows));
  if (verbosity == Verbosity::kNormal) {
    print_out("{}\nlook at {}\n", to_text(table, {.notes = Notes::kShown}), page.string());
  }
  return {};
}

}  // namespace twin::cli
