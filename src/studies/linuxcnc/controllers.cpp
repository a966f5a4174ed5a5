#include "studies/linuxcnc/controllers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "core/atomic_file.hpp"
#include "session/machine.hpp"
#include "session/report.hpp"
#include "session/session.hpp"
#include "studies/linuxcnc/evaluation.hpp"
#include "studies/linuxcnc/session.hpp"

namespace twin::studies::linuxcnc {
namespace {

namespace fs = std::filesystem;

constexpr double kHurry = 3.0;         // more would leave LinuxCNC's task behind its motion
constexpr double kStartAndEnd = 60.0;  // of LinuxCNC, on a busy computer [s]
constexpr std::array<const char*, kControllers> kNames{"twin", "LinuxCNC", "LinuxCNC, merged"};
constexpr std::array<const char*, kControllers> kFolders{"twin", "linuxcnc", "linuxcnc_merged"};

std::size_t index_of(Controller controller) { return static_cast<std::size_t>(controller); }

bool is_word_at(std::string_view line, std::size_t at, std::string_view word) {
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (at + i >= line.size() ||
        std::toupper(static_cast<unsigned char>(line[at + i])) != word[i]) {
      return false;
    }
  }
  const char next = at + word.size() < line.size() ? line[at + word.size()] : ' ';
  return std::isdigit(static_cast<unsigned char>(next)) == 0 && next != '.';
}

/// A line whose bare G64 has words behind it.
std::string line_with_tolerance(std::string_view line, const std::string& words) {
  int depth = 0;
  for (std::size_t at = 0; at < line.size() && (depth > 0 || line[at] != ';'); ++at) {
    depth += line[at] == '(' ? 1 : line[at] == ')' ? -1 : 0;
    if (depth == 0 && is_word_at(line, at, "G64") &&
        line.find_first_of("pP", at + 3) == std::string_view::npos) {
      return std::string(line.substr(0, at)) + words + std::string(line.substr(at + 3));
    }
  }
  return std::string(line);
}

Expected<std::string> text_of(const gcode::ProgramText& program) {
  std::string text(static_cast<std::size_t>(program.size()), '\0');
  TWIN_TRY(const std::size_t copied, program.copy(0, text));
  text.resize(copied);
  return text;
}

/// A run of this program's own controller.
Expected<void> run_twin(const ContestRequest& request, const gcode::ProgramText& program,
                        ProgramRow& row) {
  const std::size_t own = index_of(Controller::kTwin);
  session::Request run;
  run.program = program;
  run.machine = request.machine;
  run.folder = row.folder[own];
  run.command = request.command;
  run.make_machine = session::simulated_machine("mujoco");
  TWIN_TRY(session::Session session, session::Session::open(std::move(run)));
  TWIN_TRY(const runtime::RunResult result, session.run({.stop = request.stop}));
  if (result.failure) {
    if (result.failure->code == ErrorCode::kInterrupted) {
      return tl::unexpected(*result.failure);
    }
    row.why_not[own] = result.failure->message;
    return {};
  }
  row.summary[own] = result.summary;
  return {};
}

/// Takes a recording of LinuxCNC as the run of a controller.
void take_recording(const ContestRequest& request, const gcode::ProgramText& program,
                    const fs::path& recording, Controller controller, ProgramRow& row) {
  const std::size_t i = index_of(controller);
  std::error_code error;
  fs::remove_all(row.folder[i], error);
  fs::rename(recording, row.folder[i], error);
  if (error) {
    row.why_not[i] = error.message();
    return;
  }
  auto summary = evaluate({row.folder[i], program, request.machine, request.command});
  if (summary) {
    row.summary[i] = *std::move(summary);
  } else {
    row.why_not[i] = summary.error().message;
  }
}

Expected<void> run_in_linuxcnc(const ContestRequest& request, const Installation& installation,
                               const gcode::ProgramText& program, ProgramRow& row) {
  const double tolerance = request.machine.path.chord_error;
  TWIN_TRY(const std::string text, text_of(program));
  const fs::path folder = request.folder / row.program / "session";
  std::error_code error;
  fs::remove_all(folder, error);
  fs::create_directories(folder, error);
  SessionRequest session;
  session.installation = installation;
  session.machine = request.machine;
  session.folder = folder;
  session.hurry = kHurry;
  session.stop = request.stop;
  const auto& own = row.summary[index_of(Controller::kTwin)];
  session.time_limit = kStartAndEnd + 10.0 * (own ? own->run->machining_time : 60.0);
  for (const double merging : {0.0, tolerance}) {
    session.programs.push_back(folder /
                               fmt::format("{}.ngc", merging > 0.0 ? "merged" : "unmerged"));
    TWIN_CHECK(write_whole_file(session.programs.back(), with_tolerance(text, tolerance, merging)));
  }
  TWIN_TRY(const SessionResult result, run_linuxcnc(session));
  const std::array controllers{Controller::kUnmerged, Controller::kMerged};
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    if (i < result.recordings.size()) {
      take_recording(request, program, result.recordings[i], controllers[i], row);
    } else {
      row.why_not[index_of(controllers[i])] =
          result.told.empty() ? "LinuxCNC has not run it" : result.told;
    }
  }
  return {};
}

std::string um(double mm) { return fmt::format("{:.1f}", mm * 1e3); }

Line line_of(const ProgramRow& row, std::size_t i, double tolerance) {
  Line line{
      .row = i == 0 ? row.program : std::string(), .what = kNames[i], .cells = {}, .note = {}};
  if (!row.summary[i]) {
    line.note = row.why_not[i];
    return line;
  }
  const results::Summary& summary = *row.summary[i];
  const results::MachineResults& run = *summary.run;
  const results::AuditPeaks& peaks = summary.audit;
  const double acceleration = std::max(peaks.axis[0].acceleration, peaks.axis[1].acceleration);
  const double jerk = std::max(peaks.axis[0].jerk, peaks.axis[1].jerk);
  // The set points' own distance is known to a hundredth of the tolerance.
  const bool keeps = summary.command_contour_error.max <= 1.01 * tolerance;
  for (const std::string& text :
       {fmt::format("{:.3f}", run.machining_time),
        fmt::format("{:.2f}", summary.command_contour_error.max * 1e3), um(run.contour_error.max),
        fmt::format("{:.2f}", run.contour_error.rms * 1e3), um(run.table_contour_error.max),
        fmt::format("{:.2f}", run.table_contour_error.rms * 1e3),
        fmt::format("{:.0f}", peaks.tangential_acceleration),
        fmt::format("{:.0f}", peaks.tangential_jerk), fmt::format("{:.0f}", acceleration),
        fmt::format("{:.0f}", jerk)}) {
    line.cells.push_back({text});
  }
  line.cells.push_back({keeps ? "yes" : "no", keeps ? Mark::kNone : Mark::kOutside});
  return line;
}

}  // namespace

std::string with_tolerance(std::string_view text, double tolerance, double merging) {
  const std::string words = fmt::format("G64 P{:g} Q{:g}", tolerance, merging);
  std::string changed;
  bool has_begun = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const bool is_frame = line.find('%') != std::string_view::npos;
    if (!has_begun && !is_frame) {
      changed += words + "\n";
      has_begun = true;
    }
    changed += line_with_tolerance(line, words) + "\n";
  }
  return changed;
}

Expected<std::vector<ProgramRow>> compare_controllers(const ContestRequest& request) {
  TWIN_TRY(const Installation installation, find_installation());
  std::vector<ProgramRow> rows;
  for (std::size_t i = 0; i < request.programs.size(); ++i) {
    const gcode::ProgramText& program = request.programs[i];
    if (request.progress) {
      request.progress(static_cast<double>(i) / static_cast<double>(request.programs.size()));
    }
    ProgramRow row;
    row.program = program.file().stem().string();
    for (std::size_t k = 0; k < kControllers; ++k) {
      row.folder[k] = request.folder / row.program / kFolders[k];
    }
    TWIN_CHECK(run_twin(request, program, row));
    TWIN_CHECK(run_in_linuxcnc(request, installation, program, row));
    rows.push_back(std::move(row));
  }
  return rows;
}

TextTable table_of(const std::vector<ProgramRow>& rows, double tolerance) {
  TextTable table;
  table.title =
      fmt::format("Two controllers on one table, chord tolerance {:g} um", tolerance * 1e3);
  table.row_head = "program";
  table.note_head = "why not";
  table.head = {"time s",      "set point um", "encoder um",  "RMS",         "table um", "RMS",
                "mm/s^2 path", "mm/s^3 path",  "mm/s^2 axis", "mm/s^3 axis", "kept"};
  for (const ProgramRow& row : rows) {
    for (std::size_t i = 0; i < kControllers; ++i) {
      table.lines.push_back(line_of(row, i, tolerance));
    }
  }
  return table;
}

Expected<fs::path> write_pages(const ContestRequest& request, const std::vector<ProgramRow>& rows) {
  std::string links;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<fs::path> folders;
    for (std::size_t k = 0; k < kControllers; ++k) {
      if (rows[i].summary[k]) {
        folders.push_back(rows[i].folder[k]);
      }
    }
    if (folders.empty()) {
      continue;
    }
    const fs::path page = request.folder / rows[i].program / session::kReportName;
    const auto known = [&](const session::TraceOrigin&) {
      return std::optional(request.programs[i]);
    };
    TWIN_CHECK(session::write_report(folders, known, page));
    links += fmt::format("<li><a href=\"{0}/{1}\">{0}</a></li>\n", escape_html(rows[i].program),
                         session::kReportName);
  }
  const std::string text = fmt::format(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Two "
      "controllers</title>"
      "<style>body{{font:15px sans-serif;margin:2em}}td,th{{padding:2px 10px;text-align:right}}"
      "td:first-child,th:first-child{{text-align:left}}.out{{color:#b00}}</style></head><body>\n"
      "{}\n<p>Peaks of the set points by their differences, the larger of X and Y. LinuxCNC: G64 P "
      "of "
      "the tolerance, with Q of it where blocks are merged; its own pid at the gains of the "
      "machine "
      "file.</p>\n<ul>\n{}</ul></body></html>\n",
      to_html(table_of(rows, request.machine.path.chord_error)), links);
  const fs::path file = request.folder / "controllers.html";
  TWIN_CHECK(write_whole_file(file, text));
  return file;
}

}  // namespace twin::studies::linuxcnc
