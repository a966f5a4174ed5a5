#include "session/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gcode/block.hpp"
#include "gcode/reader.hpp"
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

Outline read_outline(const gcode::ProgramText& program, Lifted lifted, Rapids rapids,
                     gcode::ReaderOptions options) {
  ThinnedOutline outline;
  Outline read;
  options.feedrate = 1.0;  // the outline does not depend on it
  gcode::Reader reader(program, options);
  bool is_apart = true;  // the next block does not continue what is drawn
  for (auto next = reader.next(); next && next->has_value(); next = reader.next()) {
    const gcode::Block& block = **next;
    const bool is_rapid = block.motion == gcode::Motion::kRapid;
    if (is_rapid && (read.rapid_lines.empty() || read.rapid_lines.back() != block.line)) {
      read.rapid_lines.push_back(block.line);
    }
    if (is_rapid && rapids == Rapids::kLeftOut) {
      is_apart = true;
      continue;
    }
    const double height = std::min(block.start.z(), block.end.z()) - block.program_zero;
    if (lifted == Lifted::kLeftOut && height > results::kPenUp) {
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
  read.points = outline.finish();
  return read;
}

}  // namespace

Outline programmed_outline(const gcode::ProgramText& program, Rapids rapids,
                           const gcode::ReaderOptions& reading) {
  Outline outline = read_outline(program, Lifted::kLeftOut, rapids, reading);
  return outline.points.empty() ? read_outline(program, Lifted::kDrawn, rapids, reading) : outline;
}

}  // namespace twin::session
