#include "session/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/vec.hpp"
#include "gcode/block.hpp"
#include "gcode/reader.hpp"
#include "pictures/plot/figures.hpp"
#include "pictures/video/video.hpp"
#include "results/metrics/block_distance.hpp"
#include "results/trace/columns.hpp"

namespace twin::session {
namespace {

constexpr double kChordAngle = 0.02;  // of an arc [rad]

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

  /// The next point is not joined to the last one.
  void lift() {
    if (!points_.empty()) {
      points_.push_back(last_);
      points_.emplace_back(Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
      count_ = 0;
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

/// Everything of a block but its start.
void add_block(const gcode::Block& block, ThinnedOutline& outline) {
  if (block.motion == gcode::Motion::kNurbs) {
    for (const geometry::CurvatureSample& sample : block.nurbs->samples) {
      outline.add(block.nurbs->curve.position(sample.u).head<2>());
    }
    return;
  }
  const int pieces = block.motion == gcode::Motion::kArc
                         ? static_cast<int>(std::ceil(block.arc.sweep / kChordAngle))
                         : 1;
  for (int i = 1; i <= pieces; ++i) {
    outline.add(results::point_at(block, static_cast<double>(i) / pieces).head<2>());
  }
}

/// What becomes of moves with the pen up.
enum class Lifted { kLeftOut, kDrawn };

std::vector<Vec2> read_outline(const gcode::ProgramText& program, Lifted lifted) {
  ThinnedOutline outline;
  gcode::ReaderOptions options;
  options.feedrate = 1.0;  // the outline does not depend on it
  gcode::Reader reader(program, options);
  bool is_apart = true;  // the next block does not continue what is drawn
  for (auto next = reader.next(); next && next->has_value(); next = reader.next()) {
    const gcode::Block& block = **next;
    if (lifted == Lifted::kLeftOut && std::min(block.start.z(), block.end.z()) > results::kPenUp) {
      is_apart = true;
      continue;
    }
    if (is_apart) {
      outline.lift();
      outline.add(block.start.head<2>());
      is_apart = false;
    }
    add_block(block, outline);
  }
  return outline.finish();
}

/// Programmed path seen along Z, arcs as chords of a degree, moves with the pen up
/// left out (a point that is not a number lifts the line) [mm]; thinned on long programs.
std::vector<Vec2> programmed_outline(const gcode::ProgramText& program) {
  std::vector<Vec2> outline = read_outline(program, Lifted::kLeftOut);
  return outline.empty() ? read_outline(program, Lifted::kDrawn) : outline;
}

}  // namespace

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
                     json.contains("program_sha256") && json["program_sha256"].is_string()
                         ? json["program_sha256"].get<std::string>()
                         : std::string(),
                     json.contains("machining_time_s") ? TraceKind::kRun : TraceKind::kPlan};
}

Expected<void> draw_figures(const FigureRequest& request) {
  pictures::FigureInput input;
  input.directory = request.folder;
  input.title = request.title;
  if (request.program) {
    input.programmed = programmed_outline(*request.program);
  }
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
