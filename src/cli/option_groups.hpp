#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options that several commands have.
namespace twin::cli {

/// Options that follow are under this heading in the help.
void begin_group(CLI::App& command, const std::string& name);
CLI::Option* add_feedrate(CLI::App& command, std::optional<double>& feedrate,
                          const std::string& text = "Feedrate in place of the program's F words");
void add_program_name(CLI::App& command, std::string& name);
/// The program, and the feedrate in place of its own.
void add_program(CLI::App& command, ProgramArguments& program);
CLI::Option* add_list(CLI::App& command, const std::string& name, std::vector<std::string>& list,
                      const std::string& text);
CLI::Option* add_machine_file(CLI::App& command, MachineArguments& machine,
                              const std::string& text);
void add_machine(CLI::App& command, MachineArguments& machine);
/// How programs are read.
void add_reading(CLI::App& command, MachineArguments& machine);
void add_curves(CLI::App& command, MachineArguments& machine);
void add_simulated_hal(CLI::App& command, std::string& hal);
void add_faults(CLI::App& command, std::vector<std::string>& faults);
/// What of the simulated table changes while it runs.
void add_changes(CLI::App& command, std::vector<std::string>& changes);
void add_shadow(CLI::App& command, ShadowArguments& shadow);
/// The rig that is looked at.
void add_rig(CLI::App& command, RigArguments& rig);
/// The rig that moves.
void add_moving_rig(CLI::App& command, RigArguments& rig);
void add_hal(CLI::App& command, HalArguments& hal);
void add_correction(CLI::App& command, CorrectionArguments& correction);
/// @param take  gets the tolerance [mm]
CLI::Option* add_tolerance(CLI::App& command, const std::string& name, const std::string& text,
                           const std::function<void(double)>& take);
void add_overrides(CLI::App& command, std::string& overrides);
void add_quiet(CLI::App& command, Verbosity& verbosity,
               const std::string& text = "Print errors only");
/// --pdf
void add_paper(CLI::App& command, pictures::Paper& paper);

void add_no_plots(CLI::App& command, bool& has_plots);
void add_results(CLI::App& command, ResultArguments& results,
                 const std::string& folder = "PROGRAM");
/// As which files traces are written. @param has_none  whether they may be left out
void add_trace(CLI::App& command, ResultArguments& results, bool has_none = false);
/// What a run or a plan leaves and says.
void add_run_results(CLI::App& command, ResultArguments& results);
/// Results of which there are no plots.
void add_last_results(CLI::App& command, ResultArguments& results, const std::string& text);
void add_video(CLI::App& command, VideoArguments& video);
void add_axis(CLI::App& command, std::string& axis);
void add_duration(CLI::App& command, std::optional<double>& duration);

}  // namespace twin::cli
