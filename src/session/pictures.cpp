#include "session/pictures.hpp"

#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "config/machine_file.hpp"
#include "core/json.hpp"
#include "pictures/plot/figures.hpp"
#include "pictures/video/video.hpp"
#include "results/trace/trace_files.hpp"
#include "runtime/run_options.hpp"
#include "session/outline.hpp"

namespace twin::session {
namespace {

std::string text_of(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
}

/// How a program was read, by the settings of a summary; as usual where it has none of them.
gcode::ReaderOptions reading_of(const Json& summary) {
  config::MachineFile machine;
  const auto settings = summary.value(Json::json_pointer("/settings/program"), Json::object());
  for (const auto& [key, value] : settings.items()) {
    const std::string text = value.is_string() ? value.get<std::string>() : to_line(value);
    if (!text.empty()) {  // a setting that is none any more is left as it is
      static_cast<void>(config::apply_override(machine, "program." + key + "=" + text));
    }
  }
  return runtime::reader_options(machine, std::nullopt);
}

/// "dolphin.nc, simulated" where the summary beside the trace says so.
std::string video_title(const std::string& title, const std::filesystem::path& folder) {
  const auto origin = read_origin(folder);
  const auto json = parse_json(origin ? origin->summary : "");
  const bool is_simulated = json.is_object() && json.value("simulated", Json()) == true;
  return is_simulated ? title + ", simulated" : title;
}

}  // namespace

Expected<TraceOrigin> read_origin(const std::filesystem::path& folder) {
  TraceOrigin origin;
  origin.trace = results::find_trace(folder);
  origin.is_partial = results::is_partial_trace(origin.trace.filename().string());
  const auto file = folder / (origin.is_partial ? "summary.partial.json" : "summary.json");
  std::ifstream in(file);
  if (!in) {
    return tl::unexpected(Error{ErrorCode::kFile, "cannot be read; is this the folder of a run?",
                                file.string(), 0, 0});
  }
  origin.summary.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  const auto json = parse_json(origin.summary);
  if (!json.is_object() || !json.contains("program") || !json["program"].is_string()) {
    return tl::unexpected(
        Error{ErrorCode::kFile, "is not the summary of a run", file.string(), 0, 0});
  }
  origin.program = text_of(json, "program");
  origin.program_sha256 = text_of(json, "program_sha256");
  origin.command = text_of(json, "command");
  origin.reading = reading_of(json);
  const auto time = json.find("machining_time_s");
  if (time != json.end() && time->is_number()) {
    origin.machining_time = time->get<double>();
  }
  std::error_code ignored;
  if (!std::filesystem::exists(origin.trace, ignored)) {
    return tl::unexpected(Error{ErrorCode::kFile,
                                "holds no trace.csv and no trace.h5; is this the folder of a run?",
                                folder.string(), 0, 0});
  }
  origin.kind = time != json.end() ? TraceKind::kRun : TraceKind::kPlan;
  return origin;
}

Expected<void> draw_figures(const FigureRequest& request) {
  pictures::FigureInput input;
  input.directory = request.folder;
  input.trace = request.trace;
  input.title = request.title;
  if (request.program) {
    input.programmed = programmed_outline(*request.program, Rapids::kDrawn, request.reading).points;
  }
  input.paper = request.paper;
  input.plan_only = request.kind == TraceKind::kPlan;
  TWIN_CHECK(pictures::write_figures(input));
  return {};
}

Expected<void> render_video(const VideoRequest& request) {
  pictures::video::VideoInput input;
  input.trace_csv = request.folder / request.trace;
  input.scene_xml = request.model.parent_path() / "scene.xml";
  input.output = request.folder / "video.mp4";
  input.title = video_title(request.title, request.folder);
  input.camera = request.camera;
  input.progress = request.progress;
  TWIN_CHECK(pictures::video::write_video(input));
  return {};
}

}  // namespace twin::session
