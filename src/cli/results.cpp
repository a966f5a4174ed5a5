#include "cli/results.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "cli/programmed_outline.hpp"
#include "cli/progress.hpp"
#include "core/atomic_file.hpp"
#include "pictures/plot/figures.hpp"
#include "pictures/video/video.hpp"
#include "results/metrics/summary.hpp"

namespace twin::cli {

void remove_stale_results(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const char* name : {"video.mp4", "trace.partial.csv", "summary.partial.json"}) {
    std::filesystem::remove(folder / name, ignored);
  }
}

Expected<void> prepare_output_file(const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_parent_path()) {
    std::filesystem::create_directories(file.parent_path(), error);
  }
  if (error) {
    return file_error(file.parent_path(), "make this folder", error.value());
  }
  const auto existing = std::filesystem::status(file, error);
  if (std::filesystem::exists(existing) && !std::filesystem::is_regular_file(existing)) {
    return tl::unexpected(Error{
        ErrorCode::kFile, "there is something else than a file of this name", file.string(), 0, 0});
  }
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (::access(folder.c_str(), W_OK) != 0) {
    return file_error(folder, "write into this folder", errno);
  }
  return {};
}

Expected<void> write_summary(const std::filesystem::path& folder,
                             const runtime::RunResult& result) {
  return write_whole_file(folder / (result.failure ? "summary.partial.json" : "summary.json"),
                          results::to_json(result.summary));
}

Expected<void> write_plots(const std::filesystem::path& folder,
                           const std::filesystem::path& program, const std::string& title,
                           bool plan_only, bool quiet) {
  Progress progress("plots", quiet);
  progress.show(0.0);
  const pictures::FigureInput input{folder, title, programmed_outline(program), plan_only};
  auto figures = pictures::write_figures(input);
  if (!figures) {
    return tl::unexpected(figures.error());
  }
  return {};
}

Expected<void> write_video(const std::filesystem::path& folder, const std::filesystem::path& model,
                           const std::string& title, const Options& options) {
  Progress progress("video", options.quiet);
  pictures::video::VideoInput input;
  input.trace_csv = folder / "trace.csv";
  input.scene_xml = model.parent_path() / "scene.xml";
  input.output = folder / "video.mp4";
  input.title = title;
  input.camera = options.camera;
  input.progress = progress.callback();
  auto report = pictures::video::write_video(input);
  if (!report) {
    return tl::unexpected(report.error());
  }
  return {};
}

}  // namespace twin::cli
