#include "cli/results.hpp"

#include <cmath>
#include <system_error>
#include <utility>

#include "cli/progress.hpp"
#include "core/atomic_file.hpp"
#include "gcode/reader.hpp"
#include "metrics/block_distance.hpp"
#include "metrics/summary.hpp"
#include "plot/figures.hpp"
#include "render/video.hpp"

namespace twin::cli {

namespace {

/// Polyline of bounded size: when it is full, every other point goes, and of those to come as many.
class ThinnedOutline {
 public:
  void add(const Vec2& point) {
    last_ = point;
    if (count_++ % stride_ != 0) {
      return;
    }
    points_.push_back(point);
    if (points_.size() >= kMostPoints) {
      for (std::size_t i = 0; 2 * i < points_.size(); ++i) {
        points_[i] = points_[2 * i];
      }
      points_.resize((points_.size() + 1) / 2);
      stride_ *= 2;
    }
  }

  std::vector<Vec2> finish() {
    if (!points_.empty()) {
      points_.push_back(last_);
    }
    return std::move(points_);
  }

 private:
  static constexpr std::size_t kMostPoints = 200000;

  std::vector<Vec2> points_;
  Vec2 last_ = Vec2::Zero();
  std::size_t count_ = 0;
  std::size_t stride_ = 1;
};

}  // namespace

std::vector<Vec2> programmed_outline(const std::filesystem::path& program) {
  constexpr double kChordAngle = 0.02;  // of an arc [rad]
  ThinnedOutline outline;
  gcode::ReaderOptions options;
  options.feedrate = 1.0;  // the outline does not depend on it
  auto reader = program.empty() ? fail(ErrorCode::kFile, "no program")
                                : gcode::Reader::open(program.string(), options);
  bool is_first = true;
  while (reader) {
    auto block = reader->next();
    if (!block || !block->has_value()) {
      break;
    }
    if (is_first) {
      outline.add((*block)->start.head<2>());
      is_first = false;
    }
    const int pieces = (*block)->motion == gcode::Motion::kArc
                           ? static_cast<int>(std::ceil((*block)->arc.sweep / kChordAngle))
                           : 1;
    for (int i = 1; i <= pieces; ++i) {
      outline.add(metrics::point_at(**block, static_cast<double>(i) / pieces).head<2>());
    }
  }
  return outline.finish();
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
