#include "session/pictures.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "pictures/plot/figures.hpp"
#include "pictures/video/video.hpp"
#include "session/programmed_outline.hpp"

namespace twin::session {

Expected<TraceOrigin> read_origin(const std::filesystem::path& folder) {
  const auto file = folder / "summary.json";
  std::ifstream in(file);
  if (!in) {
    return tl::unexpected(Error{ErrorCode::kFile, "cannot be read; is this the folder of a run?",
                                file.string(), 0, 0});
  }
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("program") || !json["program"].is_string()) {
    return tl::unexpected(
        Error{ErrorCode::kFile, "is not the summary of a run", file.string(), 0, 0});
  }
  return TraceOrigin{json["program"].get<std::string>(),
                     json.contains("machining_time_s") ? TraceKind::kRun : TraceKind::kPlan};
}

Expected<void> draw_figures(const FigureRequest& request) {
  pictures::FigureInput input;
  input.directory = request.folder;
  input.title = request.title;
  input.programmed = programmed_outline(request.program);
  input.plan_only = request.kind == TraceKind::kPlan;
  TWIN_CHECK(pictures::write_figures(input));
  return {};
}

Expected<void> render_video(const VideoRequest& request) {
  pictures::video::VideoInput input;
  input.trace_csv = request.folder / "trace.csv";
  input.scene_xml = request.model.parent_path() / "scene.xml";
  input.output = request.folder / "video.mp4";
  input.title = request.title;
  input.camera = request.camera;
  input.progress = request.progress;
  TWIN_CHECK(pictures::video::write_video(input));
  return {};
}

}  // namespace twin::session
