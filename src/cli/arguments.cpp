#include "cli/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>

#include "cli/options.hpp"
#include "config/nearest_name.hpp"
#include "core/this_program.hpp"

namespace twin::cli {
namespace {

constexpr std::size_t kColumns = 80;     // of help texts
constexpr std::size_t kTextColumn = 30;  // where the text of an option begins

/// Help of which no line is longer than kColumns.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return row(make_option_name(option, is_positional) + make_option_opts(option),
               make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return row(command->get_name(), command->get_description());
  }
  std::string make_description(const CLI::App* command) const override {
    return wrapped(command->get_description(), 0, 0, kColumns) + "\n";
  }

 private:
  static std::string row(const std::string& name, const std::string& text) {
    const std::string label = wrapped("  " + name, 6, 0, kColumns);
    const bool is_beside = label.size() < kTextColumn;
    return label +
           (is_beside ? std::string(kTextColumn - label.size(), ' ')
                      : "\n" + std::string(kTextColumn, ' ')) +
           wrapped(text, kTextColumn, kTextColumn, kColumns) + "\n";
  }
};

/// Names that may stand in a command line after a command.
struct CommandNames {
  std::string name;
  std::vector<std::string> options;    ///< "--help", "-h"
  std::vector<CommandNames> commands;  ///< below it
};

/// What is wrong with the names in a command line; empty where nothing is. It looks into the
/// commands below: `twin rig probe`.
///
/// @param names  of the program
/// @param words  the command line without the program's name
std::string explain(const CommandNames& names, std::span<const char* const> words);

/// Whether a word is meant as an option; a negative number is not.
bool is_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && word.find_first_of("0123456789.") != 1;
}

/// The first option that a command does not have; empty if there is none.
std::string unknown_option(const CommandNames& command, std::span<const char* const> words) {
  for (const std::string_view word : words) {
    const std::string_view name = word.substr(0, word.find('='));
    if (word == "--") {
      break;
    }
    if (is_option(word) && std::ranges::find(command.options, name) == command.options.end()) {
      const auto longer = std::ranges::find_if(command.options, [name](const std::string& known) {
        return name.size() > 3 && known.starts_with(name);
      });
      return fmt::format("unknown option {}{}", name,
                         longer == command.options.end()
                             ? config::did_you_mean(name, command.options)
                             : "; did you mean " + *longer + "?");
    }
  }
  return {};
}

/// Explains the command line of a command that has others below it, of which one must follow.
std::string explain_choice(const CommandNames& command, std::span<const char* const> words) {
  std::vector<std::string> names;
  std::ranges::transform(command.commands, std::back_inserter(names), &CommandNames::name);
  if (words.empty()) {
    return command.name.empty()
               ? std::string()
               : fmt::format("{} wants a command: {}", command.name, fmt::join(names, ", "));
  }
  const std::string_view first = words[0];
  if (is_option(first)) {
    return unknown_option(command, words.first(1));
  }
  const auto chosen = std::ranges::find(command.commands, first, &CommandNames::name);
  if (chosen == command.commands.end()) {
    return fmt::format("unknown command {}{}", first, config::did_you_mean(first, names));
  }
  return explain(*chosen, words.subspan(1));
}

std::string explain(const CommandNames& names, std::span<const char* const> words) {
  return names.commands.empty() ? unknown_option(names, words) : explain_choice(names, words);
}

/// The parser of one command line. Only the command that is chosen gets its options.
class ArgumentParser {
 public:
  explicit ArgumentParser(std::span<const char* const> words)
      : asked_(as_options(words)), words_(asked_) {
    app_.formatter(std::make_shared<HelpFormatter>());
    app_.set_version_flag("-V,--version", "twin " + std::string(version()));
    app_.require_subcommand(1);
    add_commands();
  }

  Expected<Arguments> parse() {
    std::vector<std::string> reversed(words_.rbegin(), words_.rend());
    try {
      app_.parse(std::move(reversed));
    } catch (const CLI::CallForVersion& asked) {
      return TextArguments{std::string(asked.what()) + "\n"};
    } catch (const CLI::CallForHelp&) {
      return TextArguments{app_.help()};
    } catch (const CLI::ParseError& error) {
      return fail(ErrorCode::kUsage, usage_error(error));
    }
    return std::move(arguments_);
  }

 private:
  /// `twin help run` as `twin run --help`, `twin version` as `twin --version`.
  static std::vector<const char*> as_options(std::span<const char* const> words) {
    std::vector<const char*> asked(words.begin(), words.end());
    const std::string_view first = words.empty() ? "" : words[0];
    if (first == "help") {
      asked.erase(asked.begin());
      asked.push_back("--help");
    } else if (first == "version" && words.size() == 1) {
      asked[0] = "--version";
    }
    return asked;
  }

  template <class CommandArguments>
  void add(CLI::App& parent, const std::string& name, const std::string& text) {
    CLI::App* const command = parent.add_subcommand(name, text);
    if (&parent == &app_) {
      command->group(group_);
    }
    if (is_chosen(*command)) {
      add_options(*command, arguments_.emplace<CommandArguments>());
    }
  }

  void add_commands() {
    group_ = "Run and look";
    add<RunArguments>(
        app_, "run",
        "Plan a program, move the machine along it, write the results, print the summary");
    add<PlanArguments>(app_, "plan",
                       "The same without a machine: set points, planned time, limits");
    add<CheckArguments>(app_, "check",
                        "Read and verify programs and say their machining time; nothing moves");
    add<RenderArguments>(app_, "render", "Plots and video again, from the trace in a folder");
    add<ReportArguments>(app_, "report",
                         "A page to look at, from the trace in a folder; of several folders one "
                         "page that compares the runs");
    add<SettingsArguments>(app_, "settings",
                           "All settings: value, unit, range, meaning, where each comes from");
    group_ = "Studies";
    add<CompareArguments>(
        app_, "compare",
        "Planners and interpolators side by side on one program, the parameter updates too; a "
        "table of the planners for several programs");
    add<ReproduceArguments>(app_, "reproduce",
                            "Tables 1 to 5 and Figs. 12 to 19 of Wang and Yau's paper beside ours");
    add<CircleArguments>(app_, "circle",
                         "Circular test after ISO 230-4: both senses, deviations, reversal spikes");
    add<IdentifyArguments>(
        app_, "identify",
        "Fit the machine's parameters to recorded traces, and say which are shown");
    add<CompensateArguments>(
        app_, "compensate",
        "Shift a program's set points so that the identified table meets the path: a file for "
        "run --compensate");
    add<ShadowCommandArguments>(
        app_, "shadow",
        "Hold the identified table beside recorded runs and say what has changed of the machine; "
        "--learn takes them for healthy ones");
    add<FastestArguments>(
        app_, "fastest",
        "The largest feedrates at which a program keeps a tolerance, whatever the table may be "
        "like: of the program, and of each stretch of it");
    add<ConvertArguments>(
        app_, "convert",
        "Write a program as NURBS blocks of a control; runs of short blocks are fitted");
    add<BatchArguments>(app_, "batch",
                        "Run a file of jobs on all cores, into a store that keeps every result");
    add<SweepArguments>(
        app_, "sweep",
        "Run a program with many settings: a table, a page with the best of them, a machine file");
    add<TuneArguments>(
        app_, "tune",
        "Find servo gains and planner settings for least contour error, or least time within one");
    add_rig_commands();
    add_linuxcnc_commands();
  }

  void add_rig_commands() {
    CLI::App& rig = *app_.add_subcommand(
        "rig", "Bring up and exercise the rig: probe, monitor, check, jog, home, emulate");
    rig.group("Rig");
    rig.require_subcommand(1);
    add<RigProbeArguments>(rig, "probe", "Show cards, inputs and drive states; nothing moves");
    add<RigMonitorArguments>(
        rig, "monitor",
        "Show live counts, volts and inputs; nothing moves, a run may go on beside it");
    add<RigCheckArguments>(
        rig, "check",
        "Static wiring test: sign, scale and offset of each axis by a tiny open-loop move");
    add<RigJogArguments>(rig, "jog", "Move one axis from where it stands, in closed loop");
    add<RigHomeArguments>(rig, "home",
                          "Find an axis' zero by limit switch and index, and drive there");
    add<RigEmulateArguments>(
        rig, "emulate",
        "Run cards, drives and table as a process of its own on the wall clock, for --hal rig");
  }

  void add_linuxcnc_commands() {
    group_ = "LinuxCNC";
    add<PlantArguments>(app_, "plant",
                        "Hold the simulated table in a process of its own for LinuxCNC to drive");
    CLI::App& linuxcnc = *app_.add_subcommand(
        "linuxcnc", "Configure LinuxCNC, and judge what it did: config, evaluate");
    linuxcnc.group(group_);
    linuxcnc.require_subcommand(1);
    add<LinuxcncConfigArguments>(linuxcnc, "config",
                                 "Write INI and HAL files of LinuxCNC for a machine file");
    add<LinuxcncEvaluateArguments>(
        linuxcnc, "evaluate",
        "Hold a recording of twin plant against the program that LinuxCNC ran");
  }

  /// Whether the command line begins with this command, behind those above it.
  bool is_chosen(const CLI::App& command) const {
    std::size_t depth = 0;
    for (const CLI::App* above = command.get_parent(); above != &app_;
         above = above->get_parent()) {
      if (depth++ >= words_.size() || words_[0] != above->get_name()) {
        return false;
      }
    }
    return depth < words_.size() && words_[depth] == command.get_name();
  }

  std::string usage_error(const CLI::ParseError& error) const {
    CommandNames names = names_of(app_);
    names.name.clear();
    std::string text = explain(names, words_);
    if (text.empty()) {
      text = error.what();
    }
    std::ranges::replace(text, '\n', ' ');
    std::string asked = "twin";
    const CLI::App* command = &app_;
    for (const std::string_view word : words_) {
      const auto below =
          command->get_subcommands([word](const CLI::App* one) { return one->get_name() == word; });
      if (below.empty()) {
        break;
      }
      command = below.front();
      asked.append(" ").append(word);
    }
    return text + " (" + asked + " --help lists what there is)";
  }

  static CommandNames names_of(const CLI::App& command) {
    CommandNames names{command.get_name(), {}, {}};
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) {
        names.options.push_back("--" + name);
      }
      for (const std::string& name : option->get_snames()) {
        names.options.push_back("-" + name);
      }
    }
    for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; })) {
      names.commands.push_back(names_of(*below));
    }
    return names;
  }

  std::vector<const char*> asked_;      // the command line; help and version as options
  std::span<const char* const> words_;  // of asked_
  std::string group_;                   // of the commands that are added, in the help
  Arguments arguments_;
  CLI::App app_{
      "twin: digital twin of a servo XY table and of the CNC controller that drives it.\n"
      "Start with: twin run dolphin.nc, then look at renders/dolphin/report.html",
      "twin"};
};

}  // namespace

Expected<Arguments> parse_arguments(std::span<const char* const> words) {
  return ArgumentParser(words).parse();
}

}  // namespace twin::cli
