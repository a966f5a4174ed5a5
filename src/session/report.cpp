#include "session/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/must_finish.hpp"
#include "pictures/page/page.hpp"
#include "results/trace/columns.hpp"
#include "session/outline.hpp"
#include "session/results.hpp"

namespace twin::session {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostText = std::int64_t{4} << 20;  // of a program on a page [bytes]
constexpr double kSameTime = 1e-6;                         // of a trace and its summary [s]
constexpr double kSameShare = 1e-8;                        // of it; the summary has nine digits

/// The text of a program that is not too long.
Expected<std::string> shown_text(const gcode::ProgramText& program) {
  if (program.size() > kMostText) {
    return std::string();
  }
  std::string text(static_cast<std::size_t>(program.size()), '\0');
  TWIN_TRY(const std::size_t copied, program.copy(0, text));
  text.resize(copied);
  return text;
}

Expected<pictures::PageRun> read_run(const fs::path& folder, const FindProgram& find_program) {
  TWIN_TRY(const TraceOrigin origin, read_origin(folder));
  pictures::PageRun run;
  run.summary = origin.summary;
  run.is_partial = origin.is_partial;
  if (const auto shadow = read_whole_file(folder / kShadowName)) {
    run.shadow = *shadow;
  }
  TWIN_TRY(run.rows,
           pictures::read_page_rows(origin.trace, folder / "plots" / results::kLimitName));
  if (origin.machining_time && std::abs(*origin.machining_time - run.rows.last_time) >
                                   std::max(kSameTime, kSameShare * run.rows.last_time)) {
    return tl::unexpected(
        Error{ErrorCode::kFile,
              fmt::format("is not the trace of the summary beside it: it ends at {:.6f} s, the "
                          "summary's run at {:.6f} s",
                          run.rows.last_time, *origin.machining_time),
              origin.trace.string(), 0, 0});
  }
  const auto program = find_program ? find_program(origin) : std::nullopt;
  if (!program) {
    run.note = fmt::format("The program {} is not where it was, or has changed since the run.",
                           origin.program);
    return run;
  }
  Outline outline = programmed_outline(*program, Rapids::kLeftOut, origin.reading);
  TWIN_TRY(std::string text, shown_text(*program));
  if (text.empty()) {
    run.note = fmt::format("The program {} is too long for this page.", origin.program);
  }
  run.program = pictures::PageProgram{std::move(text), std::move(outline.points),
                                      std::move(outline.rapid_lines)};
  return run;
}

/// Names by which runs are told from each other: of their folders, as long as need be.
void name_runs(std::span<const fs::path> folders, std::vector<pictures::PageRun>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const fs::path folder = fs::absolute(folders[i]).lexically_normal();
    const fs::path last = folder.has_filename() ? folder : folder.parent_path();
    runs[i].name = last.filename().string();
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto is_same = [&](const pictures::PageRun& run) { return run.name == runs[i].name; };
    if (std::ranges::count_if(runs, is_same) > 1) {
      runs[i].name = folders[i].string();
    }
  }
}

}  // namespace

Expected<void> write_report(std::span<const fs::path> folders, const FindProgram& find_program,
                            const fs::path& file) {
  const MustFinish finish;
  std::vector<pictures::PageRun> runs;
  for (const fs::path& folder : folders) {
    TWIN_TRY(pictures::PageRun run, read_run(folder, find_program));
    runs.push_back(std::move(run));
  }
  name_runs(folders, runs);
  std::string title;
  for (const pictures::PageRun& run : runs) {
    title += (title.empty() ? "" : " and ") + run.name;
  }
  TWIN_TRY(const std::string text, pictures::page_text(runs, title + ", twin"));
  TWIN_CHECK(prepare_output_file(file));
  return write_whole_file(file, text, Durability::kCached);
}

}  // namespace twin::session
