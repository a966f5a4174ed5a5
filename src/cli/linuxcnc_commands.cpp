#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/machines.hpp"
#include "cli/study_commands.hpp"
#include "cli/terminal.hpp"
#include "config/find_file.hpp"
#include "hal/linuxcnc/serve_plant.hpp"
#include "hal/rig/emulator/fault.hpp"
#include "session/pictures.hpp"
#include "session/report.hpp"
#include "session/results.hpp"
#include "studies/linuxcnc/evaluation.hpp"
#include "studies/linuxcnc/machine_config.hpp"
#include "studies/linuxcnc/recording.hpp"

// The commands that meet LinuxCNC: twin plant and twin linuxcnc.
namespace twin::cli {

// Plant.

namespace {

namespace lcnc = hal::linuxcnc;

void tell_line(std::string_view line) {
  print_out("{}\n", line);
  static_cast<void>(finish_output());
}

Expected<lcnc::PlantSetup> plant_setup(const PlantArguments& arguments,
                                       const config::MachineFile& machine) {
  lcnc::PlantSetup setup;
  setup.table = machine.table;
  setup.period = machine.period;
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    setup.home_is_positive[axis] = machine.home[axis].is_positive;
  }
  for (const std::string& text : arguments.faults) {
    TWIN_TRY(const auto fault, hal::rig::emulator::parse_fault(text));
    setup.faults.push_back(fault);
  }
  return setup;
}

/// One line of what a recording shows.
std::string evaluation_line(const results::Summary& summary, const std::string& folder) {
  const results::MachineResults& run = *summary.run;
  return fmt::format(
      "{}: {}, {:.3f} s, contour error of the encoder max {:.1f}, RMS {:.2f} um, of the table max "
      "{:.1f}, RMS {:.2f} um",
      folder, summary.program, run.machining_time, run.contour_error.max * 1e3,
      run.contour_error.rms * 1e3, run.table_contour_error.max * 1e3,
      run.table_contour_error.rms * 1e3);
}

}  // namespace

Expected<void> execute(const PlantArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  std::optional<gcode::ProgramText> program;
  if (!arguments.program.empty()) {
    TWIN_TRY(program, read_program(arguments.program, arguments.machine, environment.stop));
  }
  const auto folder = session::result_folder(arguments.folder, "plant");
  studies::linuxcnc::Recordings recordings(folder, machine.period);
  lcnc::ServeSettings settings;
  TWIN_TRY(settings.setup, plant_setup(arguments, machine));
  settings.name = arguments.name;
  settings.duration = arguments.duration;
  if (arguments.has_recording) {
    settings.record = [&](const twin_segment& memory) { return recordings.take(memory); };
    settings.left = [&] { return recordings.end(); };
  }
  settings.started = [](const std::string& name) {
    tell_line(fmt::format("plant (simulated), process {}, for LinuxCNC at {}; Ctrl-C ends it",
                          getpid(), name));
  };
  TWIN_TRY(const auto result, lcnc::serve_plant(settings, environment.stop, tell_line));
  tell_line(fmt::format("{:.3f} s simulated: {} periods asked, {} simulated", result.time,
                        result.asked, result.simulated));
  for (const auto& recorded : recordings.folders()) {
    if (!program) {
      tell_line(fmt::format("recorded: {}", recorded.string()));
      continue;
    }
    TWIN_TRY(const auto summary,
             studies::linuxcnc::evaluate({recorded, *program, machine, environment.command_line}));
    tell_line(evaluation_line(summary, recorded.string()));
  }
  return {};
}

// Config and evaluate.

namespace {

constexpr const char* kShippedHalFiles =
    "/usr/share/doc/linuxcnc/examples/sample-configs/by_interface/servotogo";

/// The script that takes the place of a display.
Expected<std::filesystem::path> headless_script() {
  const auto folders = config::data_folders("hal/linuxcnc/shim");
  TWIN_TRY(const auto found, config::find_file("script", "headless", "", folders));
  return std::filesystem::absolute(found);
}

}  // namespace

Expected<void> execute(const LinuxcncConfigArguments& arguments, const Environment&) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  TWIN_TRY(const auto headless, headless_script());
  const auto folder = session::result_folder(arguments.folder, "linuxcnc");
  TWIN_TRY(const auto files,
           studies::linuxcnc::write_config(machine, folder, headless, kShippedHalFiles));
  for (const auto& file : files) {
    print_out("{}\n", file.string());
  }
  return {};
}

Expected<void> execute(const LinuxcncEvaluateArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  TWIN_TRY(const auto program,
           read_program(arguments.program, arguments.machine, environment.stop));
  TWIN_TRY(const auto summary, studies::linuxcnc::evaluate(
                                   {arguments.folder, program, machine, environment.command_line}));
  print_out("{}", results::to_table(summary, machine.limits));
  if (arguments.has_plots) {
    Progress progress("plots", Verbosity::kNormal);
    progress.show(0.0);
    TWIN_CHECK(session::draw_figures({arguments.folder, program, summary.program + ", LinuxCNC"}));
  }
  const std::array<std::filesystem::path, 1> folders{arguments.folder};
  const auto page = arguments.folder / session::kReportName;
  TWIN_CHECK(session::write_report(
      folders, [&](const session::TraceOrigin&) { return std::optional(program); }, page));
  print_out("look at {}\n", page.string());
  return {};
}

}  // namespace twin::cli
