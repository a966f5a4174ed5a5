#include "cli/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "cli/machines.hpp"
#include "core/text_table.hpp"
#include "results/quantities.hpp"
#include "session/report.hpp"
#include "session/results.hpp"
#include "session/session.hpp"

namespace twin::cli {
namespace {

namespace fs = std::filesystem;

std::string key_of(const std::string& setting) { return setting.substr(0, setting.find('=')); }

/// A name as a part of a path.
std::string as_folder(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == ' ' || c == '"' || c == '\''; }, '_');
  return name;
}

TextTable table_of(const std::vector<SettingsVariant>& variants,
                   const std::vector<results::Summary>& summaries) {
  TextTable table;
  table.head = {"time s", "contour max", "RMS um", "x max um", "y max um"};
  table.row_head = "setting";
  for (std::size_t i = 0; i < variants.size(); ++i) {
    Line line{.row = variants[i].name, .what = {}, .cells = {}, .note = {}};
    for (const char* key : {"machining_time_s", "contour_error_max_um", "contour_error_rms_um",
                            "x_tracking_error_max_um", "y_tracking_error_max_um"}) {
      const results::Quantity& quantity = results::quantity(key);
      line.cells.push_back({quantity.text(quantity.get(summaries[i]))});
    }
    table.lines.push_back(std::move(line));
  }
  return table;
}

/// Writes the page, and says where it is.
Expected<void> write_page(const std::vector<fs::path>& folders, const fs::path& out,
                          Verbosity verbosity, const session::FindProgram& find_program) {
  const fs::path file = out / session::kReportName;
  TWIN_CHECK(session::write_report(folders, find_program, file));
  if (verbosity == Verbosity::kNormal) {
    print_out("look at {}\n", file.string());
  }
  return {};
}

}  // namespace

Expected<std::vector<SettingsVariant>> variants_of(const std::vector<std::string>& settings) {
  std::map<std::string, std::vector<std::string>> by_key;
  for (const std::string& setting : settings) {
    by_key[key_of(setting)].push_back(setting);
  }
  std::size_t count = 1;
  for (const auto& [key, values] : by_key) {
    if (values.size() > 1 && count > 1 && values.size() != count) {
      return fail(ErrorCode::kUsage,
                  fmt::format("--set gives {} values of {}, and {} of another setting: there must "
                              "be one, or as many of each",
                              values.size(), key, count));
    }
    count = std::max(count, values.size());
  }
  std::vector<SettingsVariant> variants(count > 1 ? count : 0);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    for (const auto& [key, values] : by_key) {
      const bool is_varied = values.size() > 1;
      const std::string& setting = values[is_varied ? i : 0];
      variants[i].settings.push_back(setting);
      if (is_varied) {
        variants[i].name += (variants[i].name.empty() ? "" : ",") + setting;
      }
    }
  }
  return variants;
}

bool are_folders(const std::vector<std::string>& names) {
  return std::ranges::all_of(names, [](const std::string& name) {
    std::error_code ignored;
    return fs::is_directory(name, ignored);
  });
}

Expected<void> compare_folders(const CompareArguments& arguments, const Environment& environment) {
  const std::vector<fs::path> folders(arguments.programs.begin(), arguments.programs.end());
  return write_page(folders, session::result_folder(arguments.results.folder, "compare"),
                    arguments.results.verbosity, [&](const session::TraceOrigin& origin) {
                      return program_of(origin, environment.stop);
                    });
}

Expected<void> compare_variants(const CompareArguments& arguments,
                                const std::vector<SettingsVariant>& variants,
                                const gcode::ProgramText& program, const Environment& environment) {
  const fs::path out =
      session::result_folder(arguments.results.folder, program.file().stem().string() + "_compare");
  std::vector<fs::path> folders;
  std::vector<results::Summary> summaries;
  for (const SettingsVariant& variant : variants) {
    session::Request request;
    MachineArguments machine = arguments.machine;
    machine.settings = variant.settings;
    TWIN_TRY(request.machine, read_machine(machine, arguments.results.verbosity));
    request.program = program;
    request.feedrate = arguments.feedrate;
    request.folder = out / as_folder(variant.name);
    request.command = environment.command_line;
    request.trace = arguments.results.trace;
    request.make_machine = session::simulated_machine(arguments.hal);
    folders.push_back(request.folder);
    TWIN_TRY(session::Session session, session::Session::open(std::move(request)));
    Progress progress(variant.name, arguments.results.verbosity);
    session::Attendance attendance;
    attendance.stop = &environment.stop;
    attendance.progress = progress.callback();
    TWIN_TRY(runtime::RunResult result, session.run(attendance));
    if (result.failure) {
      Error failure = *result.failure;
      failure.message = variant.name + ": " + failure.message;
      return tl::unexpected(failure);
    }
    summaries.push_back(std::move(result.summary));
  }
  if (arguments.results.verbosity == Verbosity::kNormal) {
    print_out("{}\n", to_text(table_of(variants, summaries), {.cell_width = 11}));
  }
  return write_page(folders, out, arguments.results.verbosity,
                    [&](const session::TraceOrigin&) { return std::optional(program); });
}

}  // namespace twin::cli
