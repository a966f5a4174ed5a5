#include "studies/batch/job.hpp"

#include "config/find_file.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/sha256.hpp"
#include "core/this_program.hpp"
#include "session/machine.hpp"

namespace twin::studies::batch {
namespace {

/// JSON whose keys are sorted, so that equal values are equal bytes.
using SortedJson = nlohmann::json;

SortedJson json_of(const SettingValue& value) {
  return std::visit([](const auto& v) { return SortedJson(v); }, value);
}

/// All settings, the model by its content.
SortedJson json_of(const config::MachineFile& machine, const std::string& model) {
  SortedJson json = SortedJson::object();
  for (const Setting& setting : config::settings_of(machine)) {
    const std::string path = setting.section + "." + setting.key;
    json[path] = path == "table.model" ? SortedJson(model) : json_of(setting.value);
  }
  return json;
}

/// true for CSV, false for none: so they were written before there were others.
SortedJson json_of(results::TraceFiles trace) {
  if (trace == results::TraceFiles::kNone || trace == results::TraceFiles::kCsv) {
    return trace == results::TraceFiles::kCsv;
  }
  return results::kTraceFilesNames[static_cast<std::size_t>(trace)];
}

SortedJson json_of(const std::vector<runtime::OverrideChange>& overrides) {
  SortedJson json = SortedJson::array();
  for (const runtime::OverrideChange& change : overrides) {
    json.push_back({change.time, change.percent});
  }
  return json;
}

}  // namespace

const char* name_of(JobMachine machine) noexcept {
  constexpr const char* kNames[] = {"mujoco", "ideal", "none"};
  return kNames[static_cast<std::size_t>(machine)];
}

Expected<gcode::ProgramText> JobMaker::program(const std::string& name) {
  const auto known = programs_.find(name);
  if (known != programs_.end()) {
    return known->second;
  }
  TWIN_TRY(const std::filesystem::path file, config::find_program(name));
  TWIN_TRY(gcode::ProgramText text, gcode::ProgramText::read(file));
  programs_.emplace(name, text);
  return text;
}

Expected<std::string> JobMaker::model_checksum(const std::filesystem::path& model) {
  const auto known = models_.find(model.string());
  if (known != models_.end()) {
    return known->second;
  }
  TWIN_TRY(const std::string content, read_whole_file(model));
  return models_.emplace(model.string(), sha256(content)).first->second;
}

Expected<PreparedJob> JobMaker::prepare(const Job& job) {
  PreparedJob prepared{job, {}, {}, {}, {}};
  TWIN_TRY(prepared.program, program(job.program));
  TWIN_TRY(prepared.machine, session::read_machine({job.machine, job.settings}));
  std::string model;
  if (job.hal == JobMachine::kTable) {
    TWIN_TRY(model, model_checksum(prepared.machine.table.model));
  }
  SortedJson json;
  json["feedrate_mm_per_s"] = job.feedrate ? SortedJson(*job.feedrate) : SortedJson(nullptr);
  json["hal"] = name_of(job.hal);
  json["overrides"] = json_of(job.overrides);
  json["program_sha256"] = prepared.program.sha256();
  json["settings"] = json_of(prepared.machine, model);
  json["trace"] = json_of(job.trace);
  json["twin"] = version();
  prepared.canonical = json.dump();
  prepared.key = sha256(prepared.canonical);
  return prepared;
}

}  // namespace twin::studies::batch
