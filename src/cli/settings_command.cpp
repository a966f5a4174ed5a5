#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "config/find_file.hpp"
#include "config/loop_margins.hpp"
#include "config/machine_file.hpp"
#include "config/nearest_name.hpp"
#include "config/shown_settings.hpp"

// The settings of a machine file, for people.
namespace twin::cli {
namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kOriginColumn = 58;
constexpr std::size_t kMeaningIndent = 6;

void print_setting(const config::ShownSetting& setting) {
  const std::string line = fmt::format("  {} = {}", setting.key, setting.value);
  print_out("{:<{}}{}{}\n", line, kOriginColumn, line.size() >= kOriginColumn ? "  " : "",
            setting.origin);
  std::string text = setting.meaning;
  if (!setting.range.empty()) {
    text += fmt::format("{}({})", text.empty() ? "" : " ", setting.range);
  }
  if (!text.empty()) {
    print_out("{}{}\n", std::string(kMeaningIndent, ' '),
              wrapped(text, kMeaningIndent, kMeaningIndent, kWidth));
  }
}

/// Bandwidth and margins that the settings give.
void print_loops(const config::MachineFile& machine) {
  print_out("\nposition loops, by the model of the table\n");
  for (std::size_t i = 0; i < machine.servo.size(); ++i) {
    const config::LoopMargins loop =
        config::loop_margins(machine.servo[i], machine.table.axis[i], machine.period);
    print_out("  {}  bandwidth {:.1f} Hz, phase margin {:.1f} deg, gain margin {:.2f}{}\n", "xy"[i],
              loop.bandwidth_Hz, loop.phase_margin_deg, loop.gain_margin,
              loop.is_stable() ? "" : ": UNSTABLE");
  }
}

}  // namespace

Expected<void> execute(const SettingsArguments& arguments, const Environment&) {
  TWIN_TRY(const auto file, config::find_machine(arguments.machine.file));
  TWIN_TRY(const auto machine, read_machine(arguments.machine, Verbosity::kNormal));
  TWIN_TRY(const auto settings, config::shown_settings(file, arguments.machine.settings));
  std::string section;
  std::vector<std::string> names;
  for (const config::ShownSetting& setting : settings) {
    const std::string path = setting.section + "." + setting.key;
    names.push_back(path);
    names.push_back(setting.section);
    if (path.find(arguments.filter) == std::string::npos) {
      continue;
    }
    if (setting.section != section) {
      print_out("{}[{}]\n", section.empty() ? "" : "\n", setting.section);
      section = setting.section;
    }
    print_setting(setting);
  }
  if (section.empty()) {
    return fail(ErrorCode::kUsage,
                fmt::format("no setting has '{}' in its name{}", arguments.filter,
                            config::did_you_mean(arguments.filter, names)));
  }
  if (arguments.filter.empty() || std::string("servo").find(arguments.filter) == 0 ||
      arguments.filter.starts_with("servo")) {
    print_loops(machine);
  }
  return {};
}

}  // namespace twin::cli
