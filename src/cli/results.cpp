#include "cli/results.hpp"

#include <system_error>
#include <utility>

#include "cli/programmed_outline.hpp"
#include "cli/progress.hpp"
#include "core/atomic_file.hpp"
#include "metrics/summary.hpp"
#include "plot/figures.hpp"
#include "render/video.hpp"

namespace twin::cli {

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
