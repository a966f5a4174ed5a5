#include "studies/tune/tune_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/text_table.hpp"
#include "studies/batch/sweep_results.hpp"

namespace twin::studies::tune {
namespace {

std::string number(double x, int decimals) {
  return std::isfinite(x) ? fmt::format("{:.{}f}", x, decimals) : std::string("-");
}

std::string margins_text(const Trial& trial, std::size_t axis) {
  const config::LoopMargins& loop = trial.loops[axis];
  return number(dB(loop.gain_margin), 1) + " dB " + number(loop.phase_margin_deg, 0) + " deg";
}

std::string short_number(double x) { return fmt::format("{:.4g}", x); }

TextTable settings_table(const Task& task, const Tuning& tuning) {
  TextTable table;
  table.row_head = "setting";
  table.head = {"before", "after", "from", "to"};
  for (std::size_t i = 0; i < tuning.keys.size(); ++i) {
    const double before =
        number_of(tuning.before.rows.front().job.machine, tuning.keys[i]).value_or(std::nan(""));
    table.lines.push_back(
        {.row = tuning.keys[i],
         .what = {},
         .cells = {{short_number(before)},
                   {short_number(std::strtod(tuning.best.values[i].c_str(), nullptr))},
                   {short_number(task.keys[i].from)},
                   {short_number(task.keys[i].to)}},
         .note = {}});
  }
  return table;
}

TextTable programs_table(const Tuning& tuning) {
  TextTable table;
  table.row_head = "program, table";
  table.head = {"time s", "tuned", "contour um", "tuned"};
  for (const Judgement& judgement : tuning.judgements) {
    table.lines.push_back(
        {.row = fmt::format("{}{}, {}", judgement.program,
                            judgement.is_tuned_on ? "" : " (further)", judgement.table),
         .what = {},
         .cells = {{number(judgement.before.merit.time, 3)},
                   {number(judgement.after.merit.time, 3)},
                   {number(judgement.before.merit.contour_error, 1)},
                   {number(judgement.after.merit.contour_error, 1)}},
         .note = {}});
  }
  return table;
}

Json json_of(const Trial& trial) {
  Json json;
  json["time_s"] = rounded(trial.merit.time);
  json["contour_error_max_um"] = rounded(trial.merit.contour_error);
  for (std::size_t axis = 0; axis < trial.loops.size(); ++axis) {
    const config::LoopMargins& loop = trial.loops[axis];
    json["loops"][axis == 0 ? "x" : "y"] = {{"gain_margin_dB", rounded(dB(loop.gain_margin))},
                                            {"phase_margin_deg", rounded(loop.phase_margin_deg)},
                                            {"bandwidth_Hz", rounded(loop.bandwidth_Hz)}};
  }
  return json;
}

}  // namespace

std::string to_table(const Task& task, const Tuning& tuning) {
  std::string text = to_text(settings_table(task, tuning), {.cell_width = 9}) + "\n";
  text += fmt::format("margins x: {} before, {} after; y: {} before, {} after\n",
                      margins_text(tuning.before, 0), margins_text(tuning.best, 0),
                      margins_text(tuning.before, 1), margins_text(tuning.best, 1));
  text += fmt::format(
      "{} trials, {} of them without the margins of {:g} dB and {:g} deg; {} runs "
      "computed, {} in the store\n\n",
      tuning.asked, tuning.unstable, task.margins.gain_dB, task.margins.phase_deg, tuning.computed,
      tuning.found);
  return text + to_text(programs_table(tuning), {.cell_width = 10}) + "\n";
}

std::string to_json(const Task& task, const Tuning& tuning) {
  Json json;
  json["aim"] = task.aim == Aim::kTime ? "time" : "error";
  if (task.aim == Aim::kTime) {
    json["largest_error_um"] = task.largest_error;
  }
  json["programs"] = task.programs;
  json["least_margins"] = {{"gain_dB", task.margins.gain_dB},
                           {"phase_deg", task.margins.phase_deg}};
  for (std::size_t i = 0; i < tuning.keys.size(); ++i) {
    json["settings"][tuning.keys[i]] = std::strtod(tuning.best.values[i].c_str(), nullptr);
  }
  json["before"] = json_of(tuning.before);
  json["after"] = json_of(tuning.best);
  for (const Judgement& judgement : tuning.judgements) {
    json["judgements"].push_back({{"program", judgement.program},
                                  {"table", judgement.table},
                                  {"tuned_on", judgement.is_tuned_on},
                                  {"before", json_of(judgement.before)},
                                  {"after", json_of(judgement.after)}});
  }
  json["trials"] = tuning.asked;
  json["without_margins"] = tuning.unstable;
  return to_text(json);
}

Expected<void> write_tuning(const Task& task, const Tuning& tuning,
                            const std::filesystem::path& folder) {
  std::vector<batch::Row> rows;
  for (const Trial& trial : tuning.trials) {
    rows.insert(rows.end(), trial.rows.begin(), trial.rows.end());
  }
  std::vector<std::string> keys = tuning.keys;
  if (task.programs.size() > 1) {
    keys.insert(keys.begin(), "program");
  }
  std::string title = "tune";
  for (const std::string& program : task.programs) {
    title += " " + std::filesystem::path(program).filename().string();
  }
  TWIN_CHECK(batch::write_sweep(keys, rows, title, folder));
  TWIN_CHECK(write_whole_file(folder / "tune.json", to_json(task, tuning)));
  return write_whole_file(folder / "best.toml", config::to_toml(tuning.machine));
}

}  // namespace twin::studies::tune
