#include "cli/results.hpp"

#include <cmath>
#include <system_error>

#include "cli/progress.hpp"
#include "core/atomic_file.hpp"
#include "gcode/reader.hpp"
#include "metrics/block_distance.hpp"
#include "metrics/summary.hpp"
#include "plot/figures.hpp"
#include "render/video.hpp"

namespace twin::cli {

std::vector<Vec2> programmed_outline(const std::filesystem::path& program) {
  constexpr std::size_t kMostPoints = 200000;
  constexpr double kChordAngle = 0.02;  // of an arc [rad]
  std::vector<Vec2> points;
  gcode::ReaderOptions options;
  options.feedrate = 1.0;  // the outline does not depend on it
  auto reader = program.empty() ? fail(ErrorCode::kFile, "no program")
                                : gcode::Reader::open(program.string(), options);
  while (reader) {
    auto block = reader->next();
    if (!block || !block->has_value() || points.size() > kMostPoints) {
      break;
    }
    if (points.empty()) {
      points.emplace_back((*block)->start.head<2>());
    }
    const int pieces = (*block)->motion == gcode::Motion::kArc
                           ? static_cast<int>(std::ceil((*block)->arc.sweep / kChordAngle))
                           : 1;
    for (int i = 1; i <= pieces; ++i) {
      points.emplace_back(metrics::point_at(**block, static_cast<double>(i) / pieces).head<2>());
    }
  }
  return points;
}

void remove_stale_results(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const char* name : {"video.mp4", "trace.partial.csv", "summary.partial.json"}) {
    std::filesystem::remove(folder / name, ignored);
  }
}

Expected<void> write_summary(const std::filesystem::path& folder,
                             const runtime::RunResult& result) {
  return write_whole_file(folder / (result.failure ? "summary.partial.json" : "summary.json"),
                          metrics::to_json(result.summary));
}

Expected<void> write_plots(const std::filesystem::path& folder,
                           const std::filesystem::path& program, const std::string& title,
                           bool plan_only, bool quiet) {
  Progress progress("plots", quiet);
  progress.show(0.0);
  const plot::FigureInput input{folder, title, programmed_outline(program), plan_only};
  auto figures = plot::write_figures(input);
  if (!figures) {
    return tl::unexpected(figures.error());
  }
  return {};
}

Expected<void> write_video(const std::filesystem::path& folder, const std::filesystem::path& model,
                           const std::string& title, const Options& options) {
  Progress progress("video", options.quiet);
  render::VideoInput input;
  input.trace_csv = folder / "trace.csv";
  input.scene_xml = model.parent_path() / "scene.xml";
  input.output = folder / "video.mp4";
  input.title = title;
  input.camera = options.camera;
  input.progress = progress.callback();
  auto report = render::write_video(input);
  if (!report) {
    return tl::unexpected(report.error());
  }
  return {};
}

}  // namespace twin::cli
