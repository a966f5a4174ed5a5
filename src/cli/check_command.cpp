#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "core/json.hpp"
#include "runtime/program_report.hpp"
#include "runtime/run_options.hpp"

// twin check.
namespace twin::cli {
namespace {

using runtime::ProgramReport;

Json to_json(const Vec3& place) {
  return Json::array({rounded(place.x()), rounded(place.y()), rounded(place.z())});
}

Json to_json(const Error& error) {
  Json json{{"message", error.message}};
  if (!error.file.empty()) {
    json["file"] = error.file;
  }
  if (error.line > 0) {
    json["line"] = error.line;
  }
  if (error.column > 0) {
    json["column"] = error.column;
  }
  return json;
}

Json to_json(const runtime::ProgramError& error) {
  Json json = to_json(error.error);
  json["count"] = error.count;
  return json;
}

Json to_json(const gcode::Note& note) {
  return Json{{"kind", name_of(note.kind)},
              {"text", note.text},
              {"count", note.count},
              {"first_line", note.first_line}};
}

Json to_json(const runtime::ToolUse& tool) {
  return Json{{"tool", tool.number},
              {"first_line", tool.first_line},
              {"moves", tool.blocks},
              {"time_s", rounded(tool.time)}};
}

template <class Items>
Json list_of(const Items& items) {
  Json list = Json::array();
  for (const auto& item : items) {
    list.push_back(to_json(item));
  }
  return list;
}

Json to_json(const ProgramReport& report) {
  const runtime::ProgramFigures& figures = report.program;
  Json json{{"is_accepted", report.errors.empty()},
            {"errors", list_of(report.errors)},
            {"has_more_errors", report.has_more_errors},
            {"notes", list_of(report.notes)},
            {"notes_left_out", report.notes_left_out},
            {"moves", figures.blocks},
            {"lines", figures.lines},
            {"length_mm", rounded(figures.length)},
            {"end_mm", to_json(figures.end)},
            {"box_min_mm", to_json(figures.box_min)},
            {"box_max_mm", to_json(figures.box_max)}};
  Json offsets = Json::array();
  for (const int offset : report.work_offsets) {
    offsets.push_back(runtime::name_of_work_offset(offset));
  }
  json["work_offsets"] = std::move(offsets);
  if (report.errors.empty()) {
    json["tools"] = list_of(report.tools);
    json["machining_time_s"] = rounded(report.machining_time);
    json["feed_time_s"] = rounded(report.shares.feed);
    json["rapid_time_s"] = rounded(report.shares.rapid);
    json["rest_time_s"] = rounded(report.shares.rest);
  }
  return json;
}

/// "1 block", "20 blocks"
std::string blocks_of(std::int64_t count) {
  return fmt::format("{} block{}", count, count == 1 ? "" : "s");
}

/// "T1 from line 4, 20 blocks, 3.21 s; T2 ..."
std::string tools_of(const ProgramReport& report) {
  std::vector<std::string> texts;
  for (const runtime::ToolUse& tool : report.tools) {
    texts.push_back(
        fmt::format("{} from line {}, {}, {:.3f} s",
                    tool.number == 0 ? std::string("no tool") : fmt::format("T{}", tool.number),
                    tool.first_line, blocks_of(tool.blocks), tool.time));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string offsets_of(const ProgramReport& report) {
  std::vector<std::string> names;
  for (const int offset : report.work_offsets) {
    names.push_back(runtime::name_of_work_offset(offset));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void print_figures(const std::string& file, const ProgramReport& report) {
  const runtime::ProgramFigures& figures = report.program;
  print_out(
      "{}: {}, {:.3f} mm, X {:g} .. {:g}, Y {:g} .. {:g}, Z {:g} .. {:g} mm, "
      "machining time {:.3f} s\n",
      file, blocks_of(figures.blocks), figures.length, figures.box_min.x(), figures.box_max.x(),
      figures.box_min.y(), figures.box_max.y(), figures.box_min.z(), figures.box_max.z(),
      report.machining_time);
  print_out(
      "  size {:g} x {:g} x {:g} mm; {:.3f} s at F, {:.3f} s at rapids, {:.3f} s at rest; {}\n",
      figures.box_max.x() - figures.box_min.x(), figures.box_max.y() - figures.box_min.y(),
      figures.box_max.z() - figures.box_min.z(), report.shares.feed, report.shares.rapid,
      report.shares.rest, offsets_of(report));
  if (report.tools.size() > 1 || (!report.tools.empty() && report.tools.front().number != 0)) {
    print_out("  {}\n", tools_of(report));
  }
}

/// "12 times, first in line 5", or "line 5".
std::string place_of(const gcode::Note& note) {
  return note.count == 1 ? fmt::format("line {}", note.first_line)
                         : fmt::format("{} times, first in line {}", note.count, note.first_line);
}

void print_notes(const std::string& file, const ProgramReport& report) {
  for (const gcode::Note& note : report.notes) {
    std::string kind(name_of(note.kind));
    std::replace(kind.begin(), kind.end(), '_', ' ');
    print_note(fmt::format("{}: {}: {} ({})", file, kind, note.text, place_of(note)));
  }
  if (report.notes_left_out > 0) {
    print_note(fmt::format("{}: {} further notes are not shown", file, report.notes_left_out));
  }
}

/// Prints what is said of a program, errors first.
/// @returns an error for main() to print: the only one, or how many there are
Expected<void> print(const std::string& file, const ProgramReport& report, Verbosity verbosity) {
  const bool is_accepted = report.errors.empty();
  const bool has_notes = verbosity == Verbosity::kNormal && !report.notes.empty();
  if (report.errors.size() == 1 && report.errors.front().count == 1 && !has_notes) {
    return tl::unexpected(report.errors.front().error);
  }
  std::int64_t count = 0;
  for (const runtime::ProgramError& error : report.errors) {
    print_error(to_string(error.error) +
                (error.count > 1 ? fmt::format(" ({} times, first here)", error.count) : ""));
    count += error.count;
  }
  if (verbosity == Verbosity::kNormal) {
    if (is_accepted) {
      print_figures(file, report);
    }
    if (report.has_more_errors) {
      print_note(fmt::format("{}: there may be more errors; --most-errors shows more", file));
    }
    print_notes(file, report);
  }
  if (is_accepted) {
    return {};
  }
  return fail(ErrorCode::kProgram,
              fmt::format("{} is refused: {} error{}{}", file, count, count == 1 ? "" : "s",
                          report.has_more_errors ? " or more" : ""));
}

/// Reads one program and tells of it, on the terminal or in JSON.
Expected<void> check_one(const std::string& name, const CheckArguments& arguments,
                         const config::MachineFile& machine, const std::atomic<bool>& stop,
                         Json& programs) {
  std::string file = name;
  const auto report = [&]() -> Expected<ProgramReport> {
    TWIN_TRY(const gcode::ProgramText program, read_program(name, arguments.machine, stop));
    file = program.file().string();
    return runtime::report_program(program, runtime::reader_options(machine, arguments.feedrate),
                                   machine, arguments.most_errors, &stop);
  }();
  if (!arguments.is_json) {
    return report ? print(file, *report, arguments.verbosity) : tl::unexpected(report.error());
  }
  ProgramReport refused;
  if (!report) {
    refused.errors.push_back({report.error(), 1});
  }
  Json json{{"program", name}};
  json.update(to_json(report ? *report : refused));
  programs.push_back(std::move(json));
  return report && report->errors.empty()
             ? Expected<void>()
             : tl::unexpected(report ? report->errors.front().error : report.error());
}

}  // namespace

/// Checks all the programs, so that one call shows what is wrong with each.
Expected<void> execute(const CheckArguments& arguments, const Environment& environment) {
  TWIN_TRY(
      const auto machine,
      read_machine(arguments.machine, arguments.is_json ? Verbosity::kQuiet : arguments.verbosity));
  Json programs = Json::array();
  Expected<void> result;
  for (const std::string& name : arguments.programs) {
    auto checked = check_one(name, arguments, machine, environment.stop, programs);
    if (!checked && !result && !arguments.is_json) {
      print_error(result.error());
    }
    if (!checked) {
      result = std::move(checked);
    }
    if (!result && result.error().code == ErrorCode::kInterrupted) {
      break;
    }
  }
  if (arguments.is_json) {
    print_out("{}", to_text(Json{{"programs", programs}}));
  }
  return result;
}

}  // namespace twin::cli
